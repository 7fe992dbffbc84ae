/* The steps and the wall are pale plaster. */
surface plaster(color pale = color(0.60, 0.56, 0.51)) {
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * pale * (diffuse(Nf) + ambient());
}
