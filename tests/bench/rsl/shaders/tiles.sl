surface tiles(float Kd = .8, Ks = .5, frequency = 10, angle = .6) {
  float c = cos(angle), z = sin(angle);
  float ss = frequency * (c * s - z * t), tt = frequency * (z * s + c * t);
  float column = floor(ss), row = floor(tt);
  float x = ss - column - .5, y = tt - row - .5;
  float tilt = 2 * PI * cellnoise(column, row);
  float xr = x * cos(tilt) - y * sin(tilt), yr = x * sin(tilt) + y * cos(tilt);
  float star = cos(5 * atan(yr, xr)), radius = sqrt(x * x + y * y);
  float inside = 1 - smoothstep(.28, .32, radius * (1 + .3 * star));
  float border = smoothstep(.46, .49, max(abs(x), abs(y)));
  color base = mix(mix(Cs, color(.7, .2, .1), inside), color(.1, .1, .1), border);
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * (base * (ambient() + Kd * diffuse(Nf)) + (1 - border) * Ks * specular(Nf, -normalize(I), .1));
}
