surface brick(float Kd = .8, width = .1, height = .05, mortar = .01, frequency = 30;
              color brickcolor = (.6, .15, .1), mortarcolor = (.5, .5, .5)) {
  float ss = s / width, tt = t / height;
  float row = floor(tt);
  if (mod(row, 2) == 1)
    ss += .5;
  float column = floor(ss);
  ss -= column;
  tt -= row;
  float w = mortar / width * .5, h = mortar / height * .5;
  float inside = smoothstep(w, 2 * w, ss) * (1 - smoothstep(1 - 2 * w, 1 - w, ss)) * smoothstep(h, 2 * h, tt) *
                 (1 - smoothstep(1 - 2 * h, 1 - h, tt));
  float tone = .7 + .6 * cellnoise(column, row);
  float dirt = .8 + .4 * noise(frequency * s, frequency * t);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * mix(mortarcolor, brickcolor * tone, inside) * dirt * (ambient() + Kd * diffuse(Nf));
}
