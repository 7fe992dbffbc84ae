/* The functions that shaders written by Slim call, with the names and arguments of those calls. */
#ifndef PXSLUTIL_H
#define PXSLUTIL_H

/* The distance that a position moves over one sample, from its changes along u and v. */
float pxslFilterWidth(vector dQu, dQv) { return max(sqrt(length(dQu ^ dQv)), 1.0e-6); }

/* Noise that fades to its mean where its waves, one unit long, are finer than a sample. */
#define PXSL_FADE(dQu, dQv) smoothstep(0.25, 1, max(length(dQu), length(dQv)))
float pxslFilteredFNoise(point Q; vector dQu, dQv) { return mix(float noise(Q), 0.5, PXSL_FADE(dQu, dQv)); }
color pxslFilteredCNoise(point Q; vector dQu, dQv) { return mix(color noise(Q), color 0.5, PXSL_FADE(dQu, dQv)); }
vector pxslFilteredVNoise(point Q; vector dQu, dQv) { return mix(vector noise(Q), vector 0.5, PXSL_FADE(dQu, dQv)); }

/* Four corners: s goes from the first to the second and from the third to the fourth, t from the first pair to the
 * second. */
color pxslBimix(color a, b, c, d; float s, t) { return mix(mix(a, b, s), mix(c, d, s), t); }

/* Mixes each component by a weight of its own. */
color pxslCmix(color a, b, weight) { return a + (b - a) * weight; }

#endif
