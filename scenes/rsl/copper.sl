/* This metal reflects the scene a little. It reflects more at grazing angles. */
surface copper(float Ka = 1, Kd = 0.25, Ks = 0.9, roughness = 0.12, Kr = 0.5, blur = 0.1) {
  normal Nf = faceforward(normalize(N), I);
  vector In = normalize(I);
  float grazing = pow(1 - abs(In . Nf), 5);
  color tint = mix(Cs, color 1, grazing);
  color seen = 0;
  if (Kr > 0) seen = trace(P, reflect(In, Nf), "samplecone", blur, "samples", 4);
  Oi = Os;
  Ci = Os * (Cs * (Ka * ambient() + Kd * diffuse(Nf)) +
             tint * (Ks * specular(Nf, -In, roughness) + Kr * seen));
}
