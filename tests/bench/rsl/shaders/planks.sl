surface planks(float Kd = .8, Ks = .3, roughness = .15, wide = .06, long = .4; color woodcolor = (.57, .29, .12)) {
  float which = floor(s / wide);
  float tt = t / long + 10 * cellnoise(which);
  float plank = floor(tt);
  float tone = .6 + .8 * cellnoise(which, plank);
  point Q = point(s * 80, t * 4, 17 * which + 31 * plank);
  float grain = noise(Q) + .5 * noise(2 * Q);
  float ss = mod(s, wide) / wide, along = tt - plank;
  float groove = smoothstep(0, .03, ss) * smoothstep(0, .03, 1 - ss) * smoothstep(0, .005, along) *
                 smoothstep(0, .005, 1 - along);
  normal Nf = faceforward(normalize(N), I);
  color base = woodcolor * tone * (.7 + .4 * grain) * groove;
  Oi = Os;
  Ci = Os * (base * (ambient() + Kd * diffuse(Nf)) + groove * Ks * specular(Nf, -normalize(I), roughness));
}
