
// Meniscus_Own_Textures: whether each piece has its own textures. Positions and normals need one texture for all, as
// does a texture that was declared before.
#ifndef (Meniscus_Texture)
  #declare Meniscus_Own_Textures = (Meniscus_Buffer != 1 & Meniscus_Buffer != 2);
#else
  #declare Meniscus_Own_Textures = (Meniscus_Buffer > 2);
#end
// POV-Ray's shadowless lights make no highlights, so without shadows the molecule casts none.
#ifndef (Meniscus_Shadows) #declare Meniscus_Shadows = @SHADOWS@; #end
#ifndef (Meniscus_Shadow_Softness) #declare Meniscus_Shadow_Softness = @SOFTNESS@; #end
#declare Meniscus_Casts = (Meniscus_Shadows > 0);
#ifdef (Meniscus_Custom_Lights) #declare Meniscus_Casts = 1; #end
#if (Meniscus_Buffer = 0)
  #include "@NAME@_style.inc"
#else
  #include "@NAME@_aov.inc"
#end
