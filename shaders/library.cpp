#include "reyes/shader.h"

extern const rsl::Shader constantShader, matteShader, metalShader, plasticShader, paintedplasticShader,
    defaultsurfaceShader, ambientlightShader, distantlightShader, pointlightShader, spotlightShader, arealightShader,
    environmentlightShader, indirectlightShader, filterlightShader, shadowspotShader, shadowpointShader,
    shadowdistantShader, shinymetalShader, fogShader, depthcueShader, backgroundShader, clamptoalphaShader, bumpyShader,
    noisybumpShader, mirrorShader, glassShader, occlusionlightShader, disneyShader, disneycutoutShader, daylightShader,
    sunlightShader, mediumShader, subsurfaceShader;

const TmShaderLibrary* tomales_builtin_shaders(void) {
  static const TmShader* const shaders[] = {constantShader,      matteShader,          metalShader,
                                            plasticShader,       paintedplasticShader, defaultsurfaceShader,
                                            ambientlightShader,  distantlightShader,   pointlightShader,
                                            spotlightShader,     arealightShader,      environmentlightShader,
                                            indirectlightShader, filterlightShader,    shadowspotShader,
                                            shadowpointShader,   shadowdistantShader,  shinymetalShader,
                                            fogShader,           depthcueShader,       backgroundShader,
                                            clamptoalphaShader,  bumpyShader,          noisybumpShader,
                                            mirrorShader,        glassShader,          occlusionlightShader,
                                            disneyShader,        disneycutoutShader,   daylightShader,
                                            sunlightShader,      mediumShader,         subsurfaceShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  return &library;
}
