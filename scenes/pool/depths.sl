/* Clear water absorbs red first. Photons read `absorption` too. */
volume depths(color absorption = color(0.30, 0.045, 0.028)) {
  float way = length(I);
  Ci *= color(exp(-way * comp(absorption, 0)), exp(-way * comp(absorption, 1)), exp(-way * comp(absorption, 2)));
}
