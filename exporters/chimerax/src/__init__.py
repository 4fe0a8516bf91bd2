# SPDX-License-Identifier: BSD-3-Clause
"""Registers the bundle's command with ChimeraX."""
from chimerax.core.toolshed import BundleAPI


class _Bundle(BundleAPI):
    api_version = 1

    @staticmethod
    def get_class(class_name):
        """Returns the class with this name, which sessions store for each model, or None."""
        from .command import ExactSurface
        return ExactSurface if class_name == "ExactSurface" else None

    @staticmethod
    def register_command(bundle_info, command_info, logger):
        from chimerax.core.commands import register

        from .command import description, meniscus
        description.synopsis = command_info.synopsis
        register(command_info.name, description, meniscus, logger=logger)


bundle_api = _Bundle()
