surface paint(float Kd = .8, Ks = .5, frequency = 5) {
  point Q = frequency * transform("shader", P);
  color layer = color(.5, .2, .1);
  float rough = .3, shine = .3;
  float n = noise(Q), m = noise(2.7 * Q), q = noise(Q * 9);
  float primer = smoothstep(.35, .45, n + .2 * q);
  layer = mix(layer, color(.7, .7, .65), primer);
  rough = mix(rough, .2, primer);
  float coat = smoothstep(.4, .42, m + .15 * q);
  layer = mix(layer, Cs, coat);
  rough = mix(rough, .05, coat);
  shine = mix(shine, 1, coat);
  float stain = smoothstep(.6, .8, noise(.5 * Q)) * (1 - coat * .5);
  layer *= 1 - .6 * stain;
  layer = mix(layer, color(.9, .9, .95), smoothstep(.78, .8, q));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (layer * (ambient() + Kd * diffuse(Nf)) + Ks * shine * specular(Nf, -normalize(I), rough));
}
