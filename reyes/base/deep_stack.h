// The stack for nested rays, and how deep they may nest: a shader that traces a ray has the hit shaded while its own
// point is being shaded.
#pragma once
#include <cstddef>
#include <functional>

namespace tomales {

/// The most bounces of one path, and the most of any kind that users may ask for.
constexpr int kMostBounces = 1000;
/// A bounce takes about 10 KB of stack in a release build; plugins and sanitizers take more. Stack that is never
/// touched takes no memory.
constexpr size_t kBounceStack_bytes = 64 << 10;

/// Runs `body` on a stack that holds kMostBounces, and so the pool's threads until it returns. Call it once, before any
/// parallel loop. (It is defined in parallel.cpp, which alone knows the pool.)
void runOnDeepStack(const std::function<void()>& body);

}  // namespace tomales
