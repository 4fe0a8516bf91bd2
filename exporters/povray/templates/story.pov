
#ifndef (Meniscus_Material) #declare Meniscus_Material = -1; #end
#declare Meniscus_Names = array[6] {"", "opaque_", "ghost_", "glass_", "wax_", "flat_"};
#macro Meniscus_Picture(Number)
  #local File = concat("@NAME@_", Meniscus_Names[Meniscus_Material + 1], str(Number, -5, 0), ".png");
  #if (!file_exists(File))
    #error concat("There is no ", File, ". Render @NAME@.ini first, with the same section, in the folder of the scene.\n")
  #end
  image_map { png File once }
#end
global_settings { assumed_gamma 1 }
camera { orthographic location <0.5, 0.5, -1> direction z right x up y }
polygon {
  5, <0, 0>, <1, 0>, <1, 1>, <0, 1>, <0, 0>
  pigment {
    #local Place = frame_number - 1;
    #if (Meniscus_Second[Place] = 0)
      Meniscus_Picture(Meniscus_First[Place])
    #else
      average
      pigment_map {
        [1 - Meniscus_Share[Place] Meniscus_Picture(Meniscus_First[Place])]
        [Meniscus_Share[Place] Meniscus_Picture(Meniscus_Second[Place])]
      }
    #end
  }
  finish { emission 1 ambient 0 diffuse 0 }
}
