
#ifdef (Meniscus_Own_Scene) #declare @HANDLE@ = #end
@GROUP@ {
  @GEOMETRY@@CAPS@
  #if (!Meniscus_Own_Textures) texture { Meniscus_Texture } #end
  // One interior for all patches: POV-Ray then takes the open pieces for one solid.
  interior { Meniscus_Interior }
  #if (Meniscus_Casts = 0) no_shadow #end
}
