// The stack for nested rays, and the limit of nesting: when a shader traces a ray, the hit is shaded while the shader's
// own point is still being shaded.
#pragma once
#include <cstddef>
#include <functional>

namespace tomales {

/// The most bounces of one path, and the most that users may ask for in any setting.
constexpr int kMostBounces = 1000;
/// A bounce takes about 10 KB of stack in a release build; plugins and sanitizers take more. Stack that is never
/// touched takes no memory.
constexpr size_t kBounceStack_bytes = 64 << 10;

/// Runs `body` on a stack that holds kMostBounces, and gives the pool's threads such stacks until it returns. Call it
/// once, before any parallel loop. (It is defined in parallel.cpp, which alone knows the pool.)
void runOnDeepStack(const std::function<void()>& body);

}  // namespace tomales
