
// Whether each piece has textures of its own; positions and normals are those of the scene, so one texture serves all, as
// does one that was declared before.
#ifndef (Meniscus_Texture)
  #declare Meniscus_Own_Textures = (Meniscus_Buffer != 1 & Meniscus_Buffer != 2);
#else
  #declare Meniscus_Own_Textures = (Meniscus_Buffer > 2);
#end
// POV-Ray's shadowless lights make no highlights: where shadows are not wanted, it is the molecule that casts none.
#ifndef (Meniscus_Shadows) #declare Meniscus_Shadows = @SHADOWS@; #end
#ifndef (Meniscus_Shadow_Softness) #declare Meniscus_Shadow_Softness = @SOFTNESS@; #end
#declare Meniscus_Casts = (Meniscus_Shadows > 0);
#ifdef (Meniscus_Custom_Lights) #declare Meniscus_Casts = 1; #end
#if (Meniscus_Buffer = 0)
  #include "@NAME@_style.inc"
#else
  #include "@NAME@_aov.inc"
#end
