// Rays that shaders trace nest: a hit is shaded within the shading of what its ray left. This is how deep
// they may be, and the stack for it.
#pragma once
#include <cstddef>
#include <functional>

namespace tomales {

/// Bounces of one path, at most: what users may ask for of any kind.
constexpr int kMostBounces = 1000;
/// A bounce takes about 10 KB of stack in a release build; plugins and sanitizers take more. What is not
/// touched takes no memory.
constexpr size_t kBounceStack_bytes = 64 << 10;

/// Runs `body`, and the pool's threads until it returns, on stacks that hold kMostBounces. Call it once,
/// before any parallel loop. (In parallel.cpp, behind which the pool lives.)
void runOnDeepStack(const std::function<void()>& body);

}  // namespace tomales
