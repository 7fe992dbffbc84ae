#include "reyes/state.h"

namespace tomales {

mat4 Motion::at(float time) const {
  if (keys.size() == 1 || time <= times.front()) return keys.front();
  if (time >= times.back()) return keys.back();
  size_t k = 1;
  while (times[k] < time) ++k;
  const float t = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return keys[k - 1] * (1.0f - t) + keys[k] * t;
}

Motion operator*(const Motion& a, const Motion& b) {
  if (!a.moving() && !b.moving()) return Motion::still(a.keys[0] * b.keys[0]);
  std::vector<float> times;
  if (a.moving()) times.insert(times.end(), a.times.begin(), a.times.end());
  if (b.moving()) times.insert(times.end(), b.times.begin(), b.times.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Motion out{times, {}};
  for (const float t : times) out.keys.push_back(a.at(t) * b.at(t));
  return out;
}

}  // namespace tomales
