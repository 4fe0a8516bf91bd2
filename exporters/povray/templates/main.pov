
// Whether each piece has textures of its own; positions and normals are those of the scene, so one texture serves all.
#declare Meniscus_Own_Textures = (Meniscus_Buffer != 1 & Meniscus_Buffer != 2);
#if (Meniscus_Buffer = 0)
  #include "@NAME@_style.inc"
#else
  #include "@NAME@_aov.inc"
#end
