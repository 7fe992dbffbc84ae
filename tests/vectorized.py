#!/usr/bin/env python3
"""Fails if the compiler left a function of TOMALES_HOT without vector instructions.

    tests/vectorized.py build/release/tomales

A condition that does not change within a loop, or too many arrays that may overlap, makes GCC give up silently. The result
is right, but it takes several times as long. So the AVX2 version of each such function must compute with registers of 256
bits, unless it computes nothing with floats.
"""
import re
import subprocess
import sys

# These functions are marked for the instruction that counts bits, and their loops add in a fixed order.
COUNTS_BITS = {'tomales::ResolvedFrame::noiseOf'}
ON_VECTORS = re.compile(r'\tv(?!mov|broadcast|zero|insert|extract|perm)\w+ .*%ymm')
ON_ONE_FLOAT = re.compile(r'\tv(add|sub|mul|div|sqrt|min|max|comi|ucomi)ss ')


def scalar_functions(program):
    """Returns the names of AVX2 functions that compute only with single floats, and how many AVX2 functions there are."""
    text = subprocess.run(['objdump', '-d', '-C', '--no-show-raw-insn', program], check=True, capture_output=True, text=True).stdout
    scalar, count = [], 0
    for function in text.split('\n\n'):
        start = re.match(r'[0-9a-f]+ <(.*) \[clone \.avx2\]>:', function)
        if not start:
            continue
        count += 1
        name = start[1].replace('(anonymous namespace)::', '').split('(')[0]
        if name not in COUNTS_BITS and ON_ONE_FLOAT.search(function) and not ON_VECTORS.search(function):
            scalar.append(name)
    return sorted(scalar), count


def main():
    scalar, count = scalar_functions(sys.argv[1])
    for name in scalar:
        print(f'{name} has no vector instructions. -fopt-info-vec-missed tells why.')
    if count == 0:
        print(f'{sys.argv[1]} has no function for AVX2.')
    return 1 if scalar or count == 0 else 0


if __name__ == '__main__':
    sys.exit(main())
