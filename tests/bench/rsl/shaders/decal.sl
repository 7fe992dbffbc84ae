surface decal(string name = "decal"; float Kd = .8, Ks = .3, roughness = .2, scale = 4) {
  float ss = scale * (s - .5) + .5, tt = scale * (t - .5) + .5;
  color paint = texture(name, ss, tt);
  float cover = smoothstep(.2, .3, comp(paint, 0));
  float dirt = .6 + .4 * float texture(name, 3 * s, 3 * t);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (mix(Cs, paint, cover) * dirt * (ambient() + Kd * diffuse(Nf)) +
             cover * Ks * specular(Nf, -normalize(I), roughness));
}
