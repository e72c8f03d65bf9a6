"""The one file that knows numba: how the kernel is compiled, cached and announced.

`kernel` marks the functions of the solver, `inlined` the small ones on each ball's path, `formula` those that Python
may call too, `entry` the few through which Python solves. Only entries are written to disk, each with all that it calls
compiled into it.
numba would notice a change in an entry's own file only, so the cache lives in a folder named after a digest of all
compiled files: edit any formula and the kernel is rebuilt.

Environment variables:

``NUMBA_DISABLE_JIT=1``
    every function here is the plain Python that stands in the source: slower by a factor of hundreds, the same
    equations.
``QSBEARING_PLAIN_NUMBA=1``
    numba's own compiler pipeline in place of `_PartCompiler` below: the same digits, twice the compilation time. For
    versions of numba that were never tried it is used in any case.
"""

from __future__ import annotations

import gc
import hashlib
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import platformdirs
from numba import config as numba_config
from numba.core import event as numba_event
from numba.core.caching import IndexDataCacheFile
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import LoweringPass, register_pass
from numba.core.typed_passes import AnnotateTypes
from numba.core.types import unliteral

from qsbearing.private_folder import fault_of, for_the_user_alone

F = TypeVar("F", bound=Callable[..., Any])

COMPILED = not numba_config.DISABLE_JIT  # type: ignore[attr-defined]
"""False when the kernel runs as plain Python (``NUMBA_DISABLE_JIT=1``)."""

KEPT_VERSIONS = 4
"""Compiled kernels of this many versions of the source stay in the user's cache."""


def _source_digest() -> str:
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        source = path.read_bytes()
        if b"qsbearing.compiled" in source or path.name in ("workspace.py", "case.py"):
            digest.update(source)
    digest.update(b"parts" if _BUILDS_PARTS else b"plain")
    return digest.hexdigest()[:16]


def _usable_cache_folder() -> tuple[str | None, str]:
    """(the folder for this source's compiled kernel, made; why None): one to which nobody but the user can write.

    What numba caches is pickled, so that whoever writes to the folder has his own code run.
    """
    root = Path(os.environ.get("NUMBA_CACHE_DIR") or platformdirs.user_cache_dir("qsbearing"))
    try:
        root = root.resolve()
        folder = root / f"kernel-{_source_digest()}"
        with for_the_user_alone():
            folder.mkdir(parents=True, exist_ok=True)
        fault = fault_of(folder)
        if fault is not None:
            return None, f"{fault}: remove it, or name a folder of your own in NUMBA_CACHE_DIR"
        os.utime(folder)
        _forget_old_kernels(root)
    except OSError as error:
        return None, f"{error.filename or root}: {error.strerror}"
    return (str(folder), "") if os.access(folder, os.W_OK) else (None, f"{folder} cannot be written to")


def _forget_old_kernels(root: Path) -> None:
    by_age = sorted(root.glob("kernel-*"), key=lambda path: path.stat().st_mtime, reverse=True)
    for stale in by_age[KEPT_VERSIONS:]:
        shutil.rmtree(stale, ignore_errors=True)


# The pipeline of parts relies on internals of numba that were tried with these versions only.
_BUILDS_PARTS = (0, 61) <= numba.version_info[:2] <= (0, 68) and os.environ.get("QSBEARING_PLAIN_NUMBA") != "1"
_CACHE_FOLDER, _NO_FOLDER = _usable_cache_folder() if COMPILED else (None, "")
_entries: set[str] = set()


class _Part(JITCodeLibrary):
    """The code of a kernel function: there to be linked into an entry, neither optimised nor made machine code itself.

    Left to itself, numba does both for every function, each time with all that it calls, and so with the lowest ones
    many times. An entry does it once for all: well under half of the compilation time, the same digits, the same time
    a point.
    """

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout

    def finalize(self) -> None:
        """Nothing is left to do."""
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """None: there is no machine code."""
        return 0

    @property
    def codegen(self) -> _Part:
        """Who sets the environment, which machine code alone has."""
        return self

    def set_env(self, name: str, environment: object) -> None:
        """Nowhere."""


class _Whole(JITCodeLibrary):
    """The code of an entry, with all parts that it calls, and that they call."""

    def finalize(self) -> None:
        """Link, optimise, make machine code."""
        called = dict.fromkeys(self._linking_libraries)
        waiting = list(called)
        while waiting:
            library = waiting.pop()
            of_part = library._linking_libraries if isinstance(library, _Part) else ()
            waiting += [each for each in of_part if each not in called]
            called |= dict.fromkeys(of_part)
        self._linking_libraries = list(called)
        super().finalize()


@register_pass(mutates_CFG=True, analysis_only=False)
class _IntoLibrary(LoweringPass):
    """Before a function is lowered: makes the library that takes its code."""

    _name = "qsbearing_into_library"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: Any) -> bool:
        state.library = state.pipeline.library(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return True


class _PartCompiler(CompilerBase):
    """numba's compiler, but for where the code goes."""

    library: type[JITCodeLibrary] = _Part

    def define_pipelines(self) -> list[Any]:
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(_IntoLibrary, AnnotateTypes)
        passes.finalize()
        return [passes]


class _WholeCompiler(_PartCompiler):
    library = _Whole


# error_model "numpy": no hidden branch before each division; the formulas guard their own.
# no_cfunc_wrapper: nothing calls these from C, and each wrapper is another function to compile.
# _nrt: nothing here allocates, so there are no references to count.
# No fastmath: the same digits on every run, and NaN stays NaN.
_OPTIONS: Any = {"error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False, "no_rewrites": True}
_PART: Any = {"no_cpython_wrapper": True} | ({"pipeline_class": _PartCompiler} if _BUILDS_PARTS else {})
_WHOLE: Any = {"pipeline_class": _WholeCompiler} if _BUILDS_PARTS else {}
_njit: Any = numba.njit  # its stubs do not know these options


def _once(dispatcher: Any) -> Any:
    """Compiled once for all values of an argument: numba compiles a function anew for each number written in a call."""
    if COMPILED:
        template = dispatcher.get_call_template
        dispatcher.get_call_template = lambda args, names: template(
            [unliteral(each) for each in args], {name: unliteral(each) for name, each in names.items()}
        )
    return dispatcher


def kernel(function: F) -> F:
    """Compile a function of the kernel, for the entries that call it; compiled, Python cannot call it."""
    return cast(F, _once(_njit(**_OPTIONS, **_PART)(function)))


def inlined(function: F) -> F:
    """Compile a small function of each ball's evaluation and step, to stand in its callers' machine code.

    Left to itself, LLVM calls most of them: a batch takes a tenth longer. The digits are the same.
    """
    return cast(F, _once(_njit(**_OPTIONS, **_PART, forceinline=True)(function)))


def formula(function: F) -> F:
    """Compile a closed formula, for the kernel and for Python alike."""
    return cast(F, _njit(**_OPTIONS, **_WHOLE)(function))


def entry(function: F) -> F:
    """Compile a function that Python calls: cached on disk, the interpreter's lock released."""
    _entries.add(function.__qualname__)
    before = numba_config.CACHE_DIR  # type: ignore[attr-defined]
    try:
        numba_config.CACHE_DIR = _CACHE_FOLDER or before  # type: ignore[attr-defined]
        with for_the_user_alone():
            dispatcher = _njit(**_OPTIONS, **_WHOLE, nogil=True, cache=_CACHE_FOLDER is not None)(function)
    finally:
        numba_config.CACHE_DIR = before  # type: ignore[attr-defined]
    if COMPILED and _CACHE_FOLDER is not None:
        _keep_to(_CACHE_FOLDER, dispatcher)
    return cast(F, dispatcher)


def _share(folder: str, dispatcher: Any) -> None:
    """Keep it by its module's name, where numba takes the path of the file: an installation and the copy of the source
    from which it was made are compiled once. What the file holds still counts, when it was written does not."""
    cache, function = dispatcher._cache, dispatcher.py_func
    cache._cache_path = cache._impl.locator._cache_path = str(Path(folder) / function.__module__)
    content = hashlib.sha256(Path(function.__code__.co_filename).read_bytes()).hexdigest()
    cache._cache_file = IndexDataCacheFile(cache._cache_path, cache._impl.filename_base, content)


def _load_alone(cache: Any, signature: Any, target: Any) -> Any:
    """As `load_overload` does, but numba does not first take in all that it can compile: a fifth of a start's time."""
    with cache._guard_against_spurious_io_errors():
        return cache._load_overload(signature, target)


def _keep_to(folder: str, dispatcher: Any) -> None:
    """Cache there only, for the user alone; a damaged file is said and compiled anew, where numba would end in an error
    of pickle."""
    cache = dispatcher._cache
    if not Path(cache.cache_path).is_relative_to(folder):  # numba's own choice of another, which nobody has looked at
        cache.disable()
    elif _BUILDS_PARTS:
        _share(folder, dispatcher)
    load, save = _load_alone if _BUILDS_PARTS else type(cache).load_overload, cache.save_overload

    def load_or_discard(signature: Any, target: Any) -> Any:
        try:
            return load(cache, signature, target)
        except Exception as error:  # a damaged pickle may raise anything
            what = f"{type(error).__name__}: {error}"
            print(f"qsbearing: a file in {folder} is damaged ({what}): it is compiled again", file=sys.stderr)
            with for_the_user_alone():
                cache.flush()
            return None

    def save_for_the_user(signature: Any, data: Any) -> None:
        with for_the_user_alone():
            save(signature, data)

    cache.load_overload, cache.save_overload = load_or_discard, save_for_the_user


class _Compilation(numba_event.Listener):
    """Watches our entries being compiled, and says so once, on stderr: numba fires only where it found no copy.

    Meanwhile no garbage is collected: the compiler's many live objects would be gone through again and again, an eighth
    of its time, for next to none that is dead.
    """

    def __init__(self) -> None:
        self._said = False
        self._depth = 0
        self._collects = False

    def on_start(self, event: numba_event.Event) -> None:
        if self._depth == 0:
            self._collects = gc.isenabled()
            gc.disable()
        self._depth += 1
        function = event.data["dispatcher"].py_func
        if self._said or not function.__module__.startswith("qsbearing") or function.__qualname__ not in _entries:
            return
        self._said = True
        what = "the fallback for hard cases" if "fallback" in function.__module__ else "the solver"
        if ".readings." in function.__module__:
            what = "a reading"
        if "lanes" in function.__module__:
            what = "the solver of batches"
        when = f"once, cached in {_CACHE_FOLDER}" if _CACHE_FOLDER else f"at each start, not cached: {_NO_FOLDER}"
        print(f"qsbearing: compiling {what}, some seconds ({when})", file=sys.stderr, flush=True)

    def on_end(self, event: numba_event.Event) -> None:
        self._depth -= 1
        if self._depth == 0 and self._collects:
            gc.enable()


if COMPILED:
    numba_event.register("numba:compile", _Compilation())
