surface wood(float Kd = .7, Ks = .25, roughness = .12, ringscale = 12, grainscale = 60;
             color lightwood = (.69, .44, .25), darkwood = (.35, .18, .08)) {
  point Q = transform("shader", P);
  Q += .08 * (vector noise(4 * Q) - .5);
  float r = ringscale * sqrt(xcomp(Q) * xcomp(Q) + ycomp(Q) * ycomp(Q));
  r += .3 * noise(r);
  float ring = mod(r, 1), late = smoothstep(.5, .9, ring) * (1 - smoothstep(.95, 1, ring));
  float grain = smoothstep(.45, .75, noise(grainscale * point(xcomp(Q), ycomp(Q), .1 * zcomp(Q))));
  color base = mix(lightwood, darkwood, clamp(late + .25 * grain, 0, 1));
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (base * (ambient() + Kd * diffuse(Nf)) + (1 - .5 * grain) * Ks * specular(Nf, -normalize(I), roughness));
}
