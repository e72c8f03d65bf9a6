"""The one file that knows numba: how functions of the kernel are compiled, kept and announced.

The kernel's functions stand in their modules as plain Python. An entry is compiled from copies of them, whose globals
hold the dispatchers of those that they call in place of the functions: numba sees what it would see if each were
decorated, and the names stay plain. Only entries are written to disk, each with all that it calls compiled into it; one
that was kept is loaded without any of the others.

What goes beyond numba's public interface was tried with the versions named in `TRIED`. Of others, what is public alone
is used: numba's own pipeline, which takes twice the time for the same digits, and its own cache, which does not notice
damage.
"""

from __future__ import annotations

import gc
import pickle
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType
from typing import Any

import numba
from numba import config as numba_config
from numba.core import event as numba_event

from qsbearing.model.compiler import compiled_files
from qsbearing.model.compiler.private_folder import for_the_user_alone

TRIED = (0, 61), (0, 68)
IS_TRIED = TRIED[0] <= numba.version_info[:2] <= TRIED[1]

# error_model "numpy": no hidden branch before each division; the formulas guard their own.
# no_cfunc_wrapper: nothing calls these from C, and each wrapper is another function to compile.
# _nrt: nothing here allocates, so there are no references to count.
# No fastmath: the same digits on every run, and NaN stays NaN.
OPTIONS: Any = {"error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False, "no_rewrites": True}
PART: Any = {"no_cpython_wrapper": True}
WHOLE: Any = {}
njit: Any = numba.njit  # its stubs do not know these options

if IS_TRIED:
    from numba.core import compiler, serialize
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import CompilerBase, DefaultPassBuilder
    from numba.core.compiler_machinery import LoweringPass, register_pass
    from numba.core.typed_passes import AnnotateTypes
    from numba.core.types import unliteral

    class _Part(JITCodeLibrary):
        """The code of a kernel function: there to be linked into an entry, neither optimised nor made machine code.

        Left to itself, numba does both for every function, each time with all that it calls, and so with the lowest
        ones many times. An entry does it once for all: well under half of the compilation time, the same digits, the
        same time a point.
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

    PART |= {"pipeline_class": _PartCompiler}
    WHOLE |= {"pipeline_class": _WholeCompiler}

    class _Kept:
        """In place of numba's cache of a dispatcher: verified files (`compiled_files`)."""

        def __init__(self, name: str, function: Any) -> None:
            self.name, self.function = name, function
            self.compiles = False
            """Whether what is not kept is compiled."""

        def load_overload(self, signature: Any, target: Any) -> Any:
            """The compiled entry for such arguments; None where it is to be compiled."""
            content = compiled_files.read(self.name, self._key(signature, target.codegen()))
            if content is not None:
                return compiler.CompileResult._rebuild(target, *pickle.loads(content))
            if not self.compiles:
                raise _NotKeptError
            _dispatchers.fill(self.function)
            return None

        def save_overload(self, signature: Any, result: Any) -> None:
            """Keep it."""
            compiled_files.write(self.name, self._key(signature, result.codegen), serialize.dumps(result._reduce()))

        def _key(self, signature: Any, codegen: Any) -> bytes:
            source = Path(self.function.__code__.co_filename).read_bytes()
            return repr((signature, codegen.magic_tuple())).encode() + source


class _NotKeptError(Exception):
    """An entry is to be loaded, but was not compiled before."""


class _Dispatchers(dict[Any, Any]):
    """Of the kernel's functions, made as they are needed, from copies in namespaces that hold dispatchers."""

    def __init__(self) -> None:
        super().__init__()
        self._namespaces: dict[int, dict[str, Any]] = {}
        self.kinds: dict[Any, str] = {}

    def copy_of(self, function: Any) -> Any:
        """The function, in whose globals those of the kernel are dispatchers."""
        own = function.__globals__
        namespace = self._namespaces.setdefault(id(own), dict(own))
        copied = FunctionType(function.__code__, namespace, function.__name__, function.__defaults__)
        copied.__qualname__, copied.__module__ = function.__qualname__, function.__module__
        copied.__annotations__ = {}
        return copied

    def __missing__(self, function: Any) -> Any:
        options = PART if self.kinds[function] != "formula" else WHOLE
        inline = {"forceinline": True} if self.kinds[function] == "inlined" else {}
        self[function] = dispatcher = _once(njit(**OPTIONS, **options, **inline)(self.copy_of(function)))
        return dispatcher

    def fill(self, function: Any) -> None:
        """Put the dispatchers of all that a function calls, and that those call, into its copies' globals."""
        waiting, seen = [function], set()
        while waiting:
            each = waiting.pop()
            seen.add(each)
            own, namespace = each.__globals__, self.copy_of(each).__globals__
            for name in each.__code__.co_names:
                called = own.get(name)
                if isinstance(called, FunctionType) and called in self.kinds:
                    namespace[name] = self[called]
                    if called not in seen:
                        waiting.append(called)


def _once(dispatcher: Any) -> Any:
    """Compiled once for all values of an argument: numba compiles a function anew for each number written in a call."""
    if IS_TRIED:
        template = dispatcher.get_call_template
        dispatcher.get_call_template = lambda args, names: template(
            [unliteral(each) for each in args], {name: unliteral(each) for name, each in names.items()}
        )
    return dispatcher


_dispatchers = _Dispatchers()
_entries: dict[Any, str] = {}
"""Names of the functions from which entries are compiled."""


def compiled_entry(function: Any, name: str, args: tuple[Any, ...], kinds: dict[Any, str], compiles: bool) -> Any:
    """An entry's dispatcher, loaded for such arguments, or compiled where it is not kept; the interpreter's lock is
    released while it runs.

    Args:
        name: of the entry, dotted.
        kinds: of all functions of the kernel, what they are for.
        compiles: False: None where it is not kept.
    """
    _dispatchers.kinds = kinds
    signature = tuple(numba.typeof(each) for each in args)
    with _signals_later():
        if not IS_TRIED:
            return _by_public_means(function, name, signature)
        dispatcher = _dispatcher_of(function)
        _entries[dispatcher.py_func] = name
        dispatcher._cache = kept = _Kept(name, function)
        try:
            dispatcher.compile(signature)
        except _NotKeptError:
            if not compiles:
                return None
            kept.compiles = True
            with compiled_files.alone(_end_if_asked):
                dispatcher.compile(signature)
        kept.compiles = True
    return dispatcher


def filled(function: Any, kinds: dict[Any, str]) -> Any:
    """The dispatcher of a function that calls those of the kernel, which are of these kinds, ready to be compiled."""
    _dispatchers.kinds = kinds
    _dispatchers.fill(function)
    return _dispatcher_of(function)


def _dispatcher_of(function: Any) -> Any:
    return njit(**OPTIONS, **WHOLE, nogil=True)(_dispatchers.copy_of(function))


def _by_public_means(function: Any, name: str, signature: tuple[Any, ...]) -> Any:
    _dispatchers.fill(function)
    copied = _dispatchers.copy_of(function)
    _entries[copied] = name
    folder, _ = compiled_files.usable_folder()
    before = numba_config.CACHE_DIR  # type: ignore[attr-defined]
    try:
        numba_config.CACHE_DIR = str(folder or before)  # type: ignore[attr-defined]
        with for_the_user_alone():
            dispatcher = njit(**OPTIONS, nogil=True, cache=folder is not None)(copied)
            dispatcher.compile(signature)
    finally:
        numba_config.CACHE_DIR = before  # type: ignore[attr-defined]
    return dispatcher


_waiting: list[tuple[int, Any, Any]] = []
"""Signals that came while numba was at work: (number, frame, handler)."""


@contextmanager
def _signals_later() -> Iterator[None]:
    """An error that a signal's handler raises is lost where LLVM has called Python: here it is raised at the next
    function compiled, or at the end."""
    handlers: dict[int, Any] = {}

    def later(number: int, frame: object) -> None:
        _waiting.append((number, frame, handlers[number]))

    if threading.current_thread() is threading.main_thread():
        found = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
        handlers = {number: handler for number, handler in found.items() if callable(handler)}
    try:
        for number in handlers:
            signal.signal(number, later)
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        if handlers:
            _end_if_asked()


def _end_if_asked() -> None:
    """Do what the first of the signals that came asks for."""
    if _waiting and threading.current_thread() is threading.main_thread():
        number, frame, handler = _waiting[0]
        _waiting.clear()
        handler(number, frame)


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
        _end_if_asked()
        if self._depth == 0:
            self._collects = gc.isenabled()
            gc.disable()
        self._depth += 1
        name = _entries.get(event.data["dispatcher"].py_func)
        if self._said or name is None:
            return
        self._said = True
        what = "the solver for hard cases" if "fallback" in name else "the solver"
        takes = "up to half a minute"
        if ".readings." in name:
            what, takes = "a reading", "some seconds"
        if "lanes" in name:
            what = "the solver of batches"
        folder, why = compiled_files.usable_folder()
        when = f"this once, cached in {folder}" if folder else f"at each start, not cached: {why}"
        print(f"qsbearing: compiling {what}: {takes} ({when})", file=sys.stderr, flush=True)

    def on_end(self, event: numba_event.Event) -> None:
        self._depth -= 1
        if self._depth == 0 and self._collects:
            gc.enable()


numba_event.register("numba:compile", _Compilation())
