// SPDX-License-Identifier: BSD-3-Clause
// Scene-language and .ini text without numbers of a molecule.
#include "exporters/povray/scene_templates.h"

namespace meniscus::povray {

const std::string_view kMainTemplate = R"pov(
// Whether each piece has textures of its own; positions and normals are those of the scene, so one texture serves all.
#declare Meniscus_Own_Textures = (Meniscus_Buffer != 1 & Meniscus_Buffer != 2);
#if (Meniscus_Buffer = 0)
  #include "@NAME@_style.inc"
#else
  #include "@NAME@_aov.inc"
#end

@GROUP@ {
  #include @GEOMETRY@
  #if (!Meniscus_Own_Textures) texture { Meniscus_Texture } #end
  // One interior for all patches: POV-Ray then takes the open pieces for one solid.
  interior { Meniscus_Interior }
}
)pov";

const std::string_view kFrameTemplate =
    R"pov(// The frame to show: that of the animation (the .ini), or one declared before.
#ifndef (Meniscus_Frame)
  #declare Meniscus_Frame = frame_number;
  #if (Meniscus_Frame_Count = 1) #declare Meniscus_Frame = 1; #end  // of one frame POV-Ray makes no animation
#end
#if (Meniscus_Frame < 1 | Meniscus_Frame > Meniscus_Frame_Count | Meniscus_Frame != int(Meniscus_Frame))
  #error concat("There is no scene frame ", str(Meniscus_Frame, 0, 0), "; they are 1 to ",
                str(Meniscus_Frame_Count, 0, 0), ". Render @NAME@.ini, or declare Meniscus_Frame.\n")
#end
#declare Meniscus_Frame_Name = str(Meniscus_Trajectory_Frame[Meniscus_Frame - 1], -5, 0);
#declare Meniscus_Geometry = concat("@NAME@_geometry_", Meniscus_Frame_Name, ".inc");
#if (!file_exists(Meniscus_Geometry))
  #error concat("Frame ", Meniscus_Frame_Name, " (scene frame ", str(Meniscus_Frame, 0, 0), ") is missing: ",
                "there is no ", Meniscus_Geometry, ". Export it, or render in the folder of the scene.\n")
#end
)pov";

const std::string_view kStyleTemplate = R"pov(
// Lights: a key light from the upper left behind the camera, a dim fill from the right, a weak sky, and one from the
// viewer; all parallel, so that the place of the molecule does not matter.
#ifndef (Meniscus_Shadows) #declare Meniscus_Shadows = 0; #end
#ifndef (Meniscus_Key_Light) #declare Meniscus_Key_Light = rgb <0.74, 0.72, 0.68>; #end
#ifndef (Meniscus_Fill_Light) #declare Meniscus_Fill_Light = rgb <0.15, 0.17, 0.2>; #end
#ifndef (Meniscus_Sky_Light) #declare Meniscus_Sky_Light = rgb <0.05, 0.06, 0.07>; #end
#ifndef (Meniscus_Head_Light) #declare Meniscus_Head_Light = rgb <0.13, 0.13, 0.14>; #end
#ifndef (Meniscus_Custom_Lights)
  light_source {
    (-0.45*Meniscus_Right + 0.65*Meniscus_Up - 0.75*Meniscus_Forward)*1e4 color Meniscus_Key_Light
    parallel point_at 0
    #if (Meniscus_Shadows = 0) shadowless #end
  }
  light_source {
    (0.85*Meniscus_Right - 0.05*Meniscus_Up - 0.45*Meniscus_Forward)*1e4 color Meniscus_Fill_Light
    parallel point_at 0 shadowless
  }
  light_source { Meniscus_Up*1e4 color Meniscus_Sky_Light parallel point_at 0 shadowless }
  light_source { -Meniscus_Forward*1e4 color Meniscus_Head_Light parallel point_at 0 shadowless }
#end
#ifndef (Meniscus_Background) #declare Meniscus_Background = Meniscus_Default_Background; #end
#ifndef (Meniscus_Clear) #declare Meniscus_Clear = 0; #end
#if (Meniscus_Clear = 1) background { rgbt 1 } #else background { Meniscus_Background } #end

// Materials: 0 opaque, 1 ghost, 2 glass, 3 wax. Declare any of the names below before including to change it.
#switch (Meniscus_Material)
  #case (1)
    #ifndef (Meniscus_Finish)
      #declare Meniscus_Finish = finish { ambient 0.1 diffuse 1 specular 0.3 roughness 0.02 }
    #end
    #ifndef (Meniscus_Transmit) #declare Meniscus_Transmit = 0.6; #end
    #ifndef (Meniscus_Back_Transmit) #declare Meniscus_Back_Transmit = 1; #end
  #break
  #case (2)
    #ifndef (Meniscus_Finish)
      #declare Meniscus_Finish = finish { ambient 0.02 diffuse 0.12 specular 0.7 roughness 0.002 }
    #end
    #ifndef (Meniscus_Filter) #declare Meniscus_Filter = 0.93; #end
    #ifndef (Meniscus_Tint) #declare Meniscus_Tint = 0.3; #end
    #ifndef (Meniscus_Interior) #declare Meniscus_Interior = interior { ior 1.06 } #end
  #break
  #case (3)
    // Meniscus_Subsurface = 1 scatters light inside for real; it takes minutes.
    #ifndef (Meniscus_Finish)
      #if (Meniscus_Subsurface = 1)
        #declare Meniscus_Finish = finish {
          ambient 0.05 diffuse 0.8 specular 0.15 roughness 0.08 subsurface { translucency 0.4 }
        }
      #else
        #declare Meniscus_Finish = finish { ambient 0.2 diffuse 0.95 brilliance 0.7 specular 0.15 roughness 0.12 }
      #end
    #end
    #ifndef (Meniscus_Tint) #declare Meniscus_Tint = 0.75; #end
    #ifndef (Meniscus_Interior) #declare Meniscus_Interior = interior { ior 1.4 } #end
  #break
#end
#ifndef (Meniscus_Finish)
  #declare Meniscus_Finish = finish { ambient 0.1 diffuse 1 brilliance 1.2 specular 0.13 roughness 0.025 }
#end
// How much of the colours is left, the rest being white; how much light passes, coloured and uncoloured.
#ifndef (Meniscus_Tint) #declare Meniscus_Tint = 1; #end
#ifndef (Meniscus_Filter) #declare Meniscus_Filter = 0; #end
#ifndef (Meniscus_Transmit) #declare Meniscus_Transmit = 0; #end
#ifndef (Meniscus_Back_Transmit) #declare Meniscus_Back_Transmit = Meniscus_Transmit; #end
#ifndef (Meniscus_Interior) #declare Meniscus_Interior = interior { ior 1 } #end

// Textures by patch kind (0 convex, 1 toroidal, 2 concave) and colour, as seen from the solvent and from the solid.
#declare Meniscus_Color_Count = dimension_size(Meniscus_Color, 1);
#declare Meniscus_Solvent_Side = array[3][Meniscus_Color_Count];
#declare Meniscus_Solid_Side = array[3][Meniscus_Color_Count];
#for (Kind, 0, 2)
  #for (I, 0, Meniscus_Color_Count - 1)
    #declare Tinted = Meniscus_Color[I]*Meniscus_Tint + <1,1,1,0,0>*(1 - Meniscus_Tint);
    #declare Meniscus_Solvent_Side[Kind][I] = texture {
      pigment { color Tinted filter Meniscus_Filter transmit Meniscus_Transmit }
      finish { Meniscus_Finish }
    }
    #if (Meniscus_Back_Transmit = 1)
      #declare Meniscus_Solid_Side[Kind][I] = texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }
    #else
      #declare Meniscus_Solid_Side[Kind][I] = texture {
        pigment { color Tinted filter Meniscus_Filter transmit Meniscus_Back_Transmit }
        finish { Meniscus_Finish }
      }
    #end
  #end
#end
)pov";

const std::string_view kBufferTemplate = R"pov(
// Buffers of the same geometry, to check the surface or to draw outlines; render without antialiasing, with 16 bits
// and File_Gamma=1 (sections of the .ini). The alpha channel is 0 where nothing is hit.
//  1 position  rgb = (position - Meniscus_Low)/Meniscus_Extent
//  2 normal    rgb = asin(normal)/pi + 1/2, the normal on the viewer's side
//  3 group     r = (kind + 1)/4, g = (colour mod 256)/255, b = floor(colour/256)/255
//  4 layers    grey = 1/2 to the power of the number of surface layers along the ray
#declare Meniscus_Interior = interior { ior 1 }
#declare Meniscus_Flat = finish { emission 1 ambient 0 diffuse 0 }
#declare Meniscus_Solvent_Side = array[3][Meniscus_Color_Count];
#declare Meniscus_Solid_Side = array[3][Meniscus_Color_Count];
#switch (Meniscus_Buffer)
  #case (1)
    // The average of three maps divides by three.
    #declare Meniscus_Texture = texture {
      pigment {
        average
        pigment_map {
          [1 gradient x color_map { [0 rgb 0] [1 rgb <3,0,0>] }]
          [1 gradient y color_map { [0 rgb 0] [1 rgb <0,3,0>] }]
          [1 gradient z color_map { [0 rgb 0] [1 rgb <0,0,3>] }]
        }
        scale Meniscus_Extent
        translate Meniscus_Low
      }
      finish { Meniscus_Flat }
    }
  #break
  #case (2)
    #declare Meniscus_Texture = texture {
      pigment {
        average
        pigment_map {
          [1 slope x color_map { [0 rgb 0] [1 rgb <3,0,0>] }]
          [1 slope y color_map { [0 rgb 0] [1 rgb <0,3,0>] }]
          [1 slope z color_map { [0 rgb 0] [1 rgb <0,0,3>] }]
        }
      }
      finish { Meniscus_Flat }
    }
  #break
  #case (4)
    background { rgb 1 }
    #declare Meniscus_Texture = texture { pigment { rgbt <0,0,0,0.5> } finish { ambient 0 diffuse 0 } }
  #break
#end
#for (Kind, 0, 2)
  #for (I, 0, Meniscus_Color_Count - 1)
    #if (Meniscus_Buffer = 3)
      #declare Meniscus_Texture = texture {
        pigment { rgb <(Kind + 1)/4, mod(I, 256)/255, floor(I/256)/255> }
        finish { Meniscus_Flat }
      }
    #end
    #declare Meniscus_Solvent_Side[Kind][I] = texture { Meniscus_Texture }
    #declare Meniscus_Solid_Side[Kind][I] = texture { Meniscus_Texture }
  #end
#end
)pov";

const std::string_view kIniTemplate = R"ini(Input_File_Name=@NAME@.pov
Output_File_Name=@NAME@@PICTURE@.png
Output_File_Type=N
Antialias=On
Antialias_Threshold=0.05
Antialias_Depth=3
Sampling_Method=2
Display=Off

; Other pictures of the same scene: povray @NAME@.ini[ghost] and so on. For a clear background add
; Declare=Meniscus_Clear=1 Output_Alpha=On.
[opaque]
Declare=Meniscus_Material=0
Output_File_Name=@NAME@_opaque@PICTURE@.png

[ghost]
Declare=Meniscus_Material=1
Output_File_Name=@NAME@_ghost@PICTURE@.png

[glass]
Declare=Meniscus_Material=2
Output_File_Name=@NAME@_glass@PICTURE@.png
Antialias_Depth=2
Antialias_Threshold=0.1

[wax]
Declare=Meniscus_Material=3
Output_File_Name=@NAME@_wax@PICTURE@.png

; Buffers of the same geometry, described in @NAME@_aov.inc.
[position]
Declare=Meniscus_Buffer=1
Output_File_Name=@NAME@_position@PICTURE@.png
Antialias=Off
Bits_Per_Color=16
File_Gamma=1.0
Output_Alpha=On

[normal]
Declare=Meniscus_Buffer=2
Output_File_Name=@NAME@_normal@PICTURE@.png
Antialias=Off
Bits_Per_Color=16
File_Gamma=1.0
Output_Alpha=On

[group]
Declare=Meniscus_Buffer=3
Output_File_Name=@NAME@_group@PICTURE@.png
Antialias=Off
Bits_Per_Color=16
File_Gamma=1.0
Output_Alpha=On

[layers]
Declare=Meniscus_Buffer=4
Output_File_Name=@NAME@_layers@PICTURE@.png
Antialias=Off
Bits_Per_Color=16
File_Gamma=1.0
)ini";

}  // namespace meniscus::povray
