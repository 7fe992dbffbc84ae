// The calls behind TmServices that are about light.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

void diffuse(void* host, const TmGrid*, TmConstVec3 N, TmVec3 out);
void diffuseOf(void* host, const TmGrid*, int32_t which, TmConstVec3 N, TmVec3 out);
void ambient(void* host, const TmGrid*, TmVec3 out);
int32_t light(void* host, const TmGrid*, int32_t index, TmLightSample* out);
int32_t illuminance(void* host, const TmGrid*, TmIlluminance*);
void shadow(void* host, const TmGrid*, const char* name, TmConstVec3 P, const TmShadowLookup*, TmVec3 out);
void indirectDiffuse(void* host, const TmGrid*, TmConstVec3 N, TmVec3 out, TmVec3* dominant);

/// RSL categories: is a light of `categories` (names by commas) one that `expression` names? ',' and '|' join
/// alternatives, '&' conditions, '-' excludes; an empty expression names all.
bool inCategory(std::string_view categories, std::string_view expression);

}  // namespace tomales
