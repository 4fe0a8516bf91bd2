#!/usr/bin/env bash
# Makes the Blender extension, one zip per platform, from the add-on and the wheels of scripts/package/wheels.py.
#
#   scripts/extension.sh WHEELS_FOLDER OUT_FOLDER [PLATFORM...]     platforms: linux-x64, linux-arm64, windows-x64,
#                                                                    macos-arm64, macos-x64; all by default
exec python3 -B "$(dirname "$0")/../exporters/blender/make_extension.py" "$@"
