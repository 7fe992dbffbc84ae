surface checker(float Kd = .8, frequency = 12; color dark = (.1, .1, .1)) {
  float ss = s * frequency, tt = t * frequency;
  float ws = max(abs(Du(ss) * du) + abs(Dv(ss) * dv), 1e-6), wt = max(abs(Du(tt) * du) + abs(Dv(tt) * dv), 1e-6);
  float a = mod(ss, 1), b = mod(tt, 1);
  float fs = clamp((a + .5 * ws - .5) / ws, 0, 1) - clamp((a + .5 * ws - 1) / ws, 0, 1);
  float ft = clamp((b + .5 * wt - .5) / wt, 0, 1) - clamp((b + .5 * wt - 1) / wt, 0, 1);
  float odd = fs + ft - 2 * fs * ft;
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * mix(Cs, dark, odd) * (ambient() + Kd * diffuse(Nf));
}
