"""Checks the names and types of Metal shaders. No compiler for Metal runs here; the language is C++ with vectors, which
clang has, and metal_stdlib.h declares its library."""

import pathlib

import clang.cindex

HEADER = pathlib.Path(__file__).resolve().with_name("metal_stdlib.h")
# Metal has no double. Attributes such as [[stage_in]] are unknown, hence -w.
OPTIONS = ["-x", "c++", "-std=c++17", "-nostdinc", "-w", "-Xclang", "-cl-single-precision-constant", "-include", str(HEADER)]


def errors(source):
    """What clang rejects, one line each."""
    source = source.replace("#include <", "// <")
    unit = clang.cindex.Index.create().parse("material.cpp", OPTIONS, [("material.cpp", source)])
    found = [d for d in unit.diagnostics if d.severity >= clang.cindex.Diagnostic.Error]
    return "\n".join(f"{d.location.line}: {d.spelling}" for d in found)
