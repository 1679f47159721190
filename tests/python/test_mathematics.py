"""The module computes with its own mathematics: the same bits as the command line, whatever Python has loaded."""

import os
import pathlib
import re
import subprocess
import sys

import uchain
from conftest import optional

# Names of the C library's mathematics, without the suffixes f and l.
MATHS = (
    "exp exp2 exp10 expm1 log log2 log10 log1p pow sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh "
    "atanh cbrt hypot fma tgamma lgamma"
).split()


def is_maths(name: str) -> bool:
    return any(name in (base, base + "f", base + "l") for base in MATHS)


def bindings(program: str, library: str) -> set[str]:
    """Functions of mathematics that the loader binds for a library, and whom it takes them from, by its own word."""
    env = os.environ | {"LD_DEBUG": "bindings", "LD_BIND_NOW": "1"}
    done = subprocess.run([sys.executable, "-c", program], env=env, capture_output=True, text=True, check=True)
    line = re.compile(r"binding file (\S+) \[\d+\] to (\S+) \[\d+\]: normal symbol `(\w+)'")
    found = (line.search(text) for text in done.stderr.splitlines())
    return {f"{match[3]} of {pathlib.Path(match[2]).name}" for match in found if match
            and pathlib.Path(match[1]).name == library and is_maths(match[3])}


def shown(library: pathlib.Path) -> list[str]:
    """Functions of mathematics that a library shows to whoever loads it."""
    listing = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)
    return [name for line in listing.stdout.splitlines() if is_maths(name := line.split()[-1])]


def test_the_loader_binds_no_mathematics_for_the_module_and_it_shows_none():
    native = pathlib.Path(uchain._uchain.__file__)
    assert bindings("import math, uchain", native.name) == set()
    assert shown(native) == []
    native = pathlib.Path(optional("own_law.own_law").__file__)
    assert bindings("import math, own_law", native.name) == set()
    assert shown(native) == []


def test_control_a_library_linked_without_the_flags_gets_the_mathematics_of_the_c_library():
    control = pathlib.Path(os.environ["UCHAIN_CONTROL_MODULE"])
    # As Python has it: the C library's mathematics is in the process before the module is.
    program = f"import ctypes, math; ctypes.CDLL({str(control)!r}).exp_here"
    assert "exp" in shown(control)
    assert "exp of libm.so.6" in bindings(program, control.name)
