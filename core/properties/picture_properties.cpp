// SPDX-License-Identifier: BSD-3-Clause
// Properties of the camera and of the picture that it makes.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr std::string_view kCamera = "Camera", kPicture = "Picture";

constexpr auto kTable = of_commands(
    kForFigures | for_mesh,
    std::to_array<Property>({
        camera("camera.from", "--camera", "FILE",
               "Camera as JSON, in a file or typed here; or PyMOL's get_view or ChimeraX's view matrix")
            .initially("shows everything")
            .in(kCamera, kShared | live)
            .in_short_help(),
        word("camera.projection", "--projection", "WORD",
             "Projection of the default camera: perspective or orthographic")
            .one_of("perspective|orthographic")
            .initially("perspective")
            .in(kCamera, kShared | live)
            .excludes("camera.from"),
        text("camera.view", "--view", "SIDE",
             "Side that faces the viewer: front (the broad side), back, top, bottom, right, left; x, y, z: axes of the "
             "file; 1, 2, 3: axes of inertia, longest first; symmetry: along the axis of --assembly, symmetry-side: "
             "with that axis upright. A minus sign in front turns to the opposite side")
            .initially("front")
            .in(kCamera, kShared | live)
            .in_short_help()
            .excludes("camera.from"),
        text("camera.turn", "--turn", "AXISANGLE",
             "Turn the molecule about an axis of the picture, in degrees: y90, x-30, z45 (x points right, y up, z to "
             "the viewer). Repeatable, in this order")
            .in(kCamera, kShared | live | repeatable)
            .in_short_help(),
        text("camera.zoom_to", "--zoom-to", "EXPR", "Fill the picture with these atoms")
            .initially("all that --show leaves")
            .in(kCamera, kShared | live)
            .in_short_help(),
        file("camera.path", "--camera-path", "FILE", "Key frames of a moving camera as JSON: frame, camera")
            .in(kCamera, kShared)
            .of(kForFigures & ~for_preview)
            .excludes("camera.from|camera.view|camera.turn|camera.zoom_to"),
        number("camera.turntable", "--turntable", "TURNS",
               "Turns of the camera around the molecule's middle over the run; negative: the other way round")
            .in(kCamera, kShared)
            .in_short_help()
            .of(kForFigures & ~for_preview),
        text("camera.follow", "--follow", "EXPR", "Move the camera with the middle of these atoms")
            .in(kCamera, kShared)
            .of(kForFigures & ~for_preview),
        new_file("camera.save", "--save-camera", "FILE", "Write the camera used, as JSON for --camera")
            .in(kCamera)
            .of(for_render | for_povray | for_path_tracers),

        text("image.size", "--size", "WxH", "Size in pixels")
            .initially("1280x960")
            .in(kPicture, kShared | live)
            .in_short_help()
            .of(kForFigures | for_mesh | for_bench),
        text("image.width", "--width", "LENGTH", "Width of the picture: 85mm, 8.5cm, 3.5in, 1000px; the height follows")
            .in(kPicture, kShared | live)
            .in_short_help()
            .excludes("image.size"),
        text("image.height", "--height", "LENGTH",
             "Height of the picture in the same units; the width follows unless it is given")
            .in(kPicture, kShared | live)
            .excludes("image.size"),
        number("image.dpi", "--dpi", "N", "Dots per inch, for lengths and for programs that print")
            .from(1, 1e5)
            .initially("300 for lengths")
            .in(kPicture, kShared | live),
        count("image.samples", "--samples", "N", "Rays per pixel; the first goes through its centre")
            .from(1, 1024)
            .initially("9")
            .in(kPicture, kShared | live)
            .in_short_help()
            .of(for_render | for_preview),
        text("image.background", "--background", "COLOR", "transparent, white, black or #rrggbb")
            .proposes("transparent|white|black")
            .initially("transparent")
            .in(kPicture, kShared | live)
            .in_short_help()
            .of(for_render | for_preview),
        flag("image.aovs", "--aovs", "Add Z, N.xyz, P.xyz, atom, kind and component of each pixel's centre to an .exr")
            .in(kPicture, kShared)
            .of(for_render),
        text("image.extent", "--extent", "WORD",
             "Compute on the GPU only what this view needs: visible (the same picture, pixel for pixel); complete "
             "(everything, by the same method); paper (as Krone et al. 2010 select it: deep clefts may have holes)")
            .proposes("visible|complete|paper")
            .in(kPicture, kShared)
            .of(for_render),
        flag("picture.stats", "--stats",
             "With --extent: print what each group of stages found, and its time, on standard error")
            .in(kPicture, rare)
            .of(for_render),
        flag("picture.provenance", "--provenance",
             "Store the command line in .png, .tif, .jpg and .exr, so that the picture can be made again")
            .in(kPicture, in_bundle)
            .of(for_render),
        flag("picture.no_provenance", "--no-provenance",
             "Do not store the program's version and the scene (all of these options, without folders)")
            .in(kPicture, in_bundle)
            .of(for_render),
    }));

}  // namespace

std::span<const Property> picture_properties() { return kTable; }

}  // namespace meniscus
