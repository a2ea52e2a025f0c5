"""Slang's compiler, out of the PyPI package slangpy, through the library's C interface."""

import ctypes
import importlib.util
import pathlib

# Of slang-deprecated.h: SLANG_SPIRV, SLANG_SOURCE_LANGUAGE_SLANG.
SPIRV, SLANG = 6, 1


class Compiler:
    def __init__(self):
        package = pathlib.Path(importlib.util.find_spec("slangpy").origin).parent
        [path] = package.glob("libslang-compiler.so*")
        self.library = ctypes.CDLL(str(path))
        self.session = self.call("spCreateSession", None, result=ctypes.c_void_p)

    def call(self, name, *arguments, result=ctypes.c_int):
        function = self.library[name]
        function.restype = result
        return function(*arguments)

    def compile(self, source):
        """What the compiler says of a module with entry points, and whether it makes SPIR-V of it."""
        pointer = ctypes.c_void_p
        session = pointer(self.session)
        request = pointer(self.call("spCreateCompileRequest", session, result=pointer))
        self.call("spSetCodeGenTarget", request, SPIRV, result=None)
        self.call("spSetTargetProfile", request, 0, self.call("spFindProfile", session, b"glsl_450"), result=None)
        unit = self.call("spAddTranslationUnit", request, SLANG, b"")
        self.call("spAddTranslationUnitSourceString", request, unit, b"material", source.encode(), result=None)
        good = self.call("spCompile", request) >= 0
        output = self.call("spGetDiagnosticOutput", request, result=ctypes.c_char_p).decode()
        self.call("spDestroyCompileRequest", request, result=None)
        return output, good
