"""All entries of the kernel, compiled by numba into one module of LLVM's intermediate code and optimised there, once.

Left to itself, numba optimises every function and makes machine code of it, each time with all that it calls, and so
the lowest ones many times. Here every function is typed and lowered once, in one process and one order, since numba
numbers what it compiles. What goes beyond its public interface holds for the version that pyproject.toml names.
"""

from __future__ import annotations

from typing import Any

import llvmlite.binding as llvm
from numba import config
from numba.core import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import LoweringPass, register_pass
from numba.core.typed_passes import AnnotateTypes

from qsbearing.model.compiler import compiled
from qsbearing.model.compiler.numba_kernel import OPTIONS, Dispatchers, njit, signature
from tests.verification.kernel_library import entry_points

# What numba takes from the computer that it runs on: nothing.
config.CPU_NAME, config.CPU_FEATURES = "x86-64-v3", ""  # type: ignore[attr-defined]
# no_cfunc_wrapper, no_cpython_wrapper: each is another function to compile.
# _nrt: nothing here allocates, so there are no references to count.
ALONE: Any = {"no_cfunc_wrapper": True, "no_cpython_wrapper": True, "_nrt": False, "no_rewrites": True}


class _Part(JITCodeLibrary):
    """The code of a function: there to be linked, neither optimised nor made machine code."""

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


@register_pass(mutates_CFG=True, analysis_only=False)
class _IntoPart(LoweringPass):
    """Before a function is lowered: makes the library that takes its code."""

    _name = "qsbearing_into_part"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: Any) -> bool:
        state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        return True


class _PartCompiler(CompilerBase):
    """numba's compiler, but for where the code goes."""

    def define_pipelines(self) -> list[Any]:
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(_IntoPart, AnnotateTypes)
        passes.finalize()
        return [passes]


def _part(function: Any, kind: str) -> Any:
    """A dispatcher, compiled once for all values of an argument: numba compiles anew for each number in a call."""
    inline = {"forceinline": True} if kind == "inlined" else {}
    dispatcher = njit(**OPTIONS, **ALONE, **inline, pipeline_class=_PartCompiler)(function)
    template = dispatcher.get_call_template
    dispatcher.get_call_template = lambda args, names: template(
        [types.unliteral(each) for each in args], {name: types.unliteral(each) for name, each in names.items()}
    )
    return dispatcher


def compiled_module(entries: list[compiled.CompiledEntry]) -> tuple[str, dict[str, dict[str, Any]]]:
    """(the optimised module as text, what the manifest states of each entry)."""
    dispatchers = Dispatchers(compiled.functions, _part)
    parts: dict[Any, None] = {}
    stated, texts, codegen = {}, [], None
    for each in entries:
        dispatcher = _part(dispatchers.filled(each.function), "entry")
        dispatcher.compile(signature(each.kinds))
        [result] = dispatcher.overloads.values()
        codegen = result.library._codegen
        waiting = [result.library]
        while waiting:
            library = waiting.pop()
            if library not in parts:
                parts[library] = None
                waiting += library._linking_libraries
        returns = entry_points.letters(result.signature.return_type)
        point = entry_points.EntryPoint(each, result.fndesc.llvm_func_name, returns)
        texts.append(point.text)
        stated[each.name] = {
            "symbol": point.symbol,
            "kinds": [str(kind) for kind in each.flat_kinds],
            "returns": returns,
        }
    whole = JITCodeLibrary(codegen, "kernel")
    for library in parts:
        whole._final_module.link_in(library._final_module, preserve=True)
    points = llvm.parse_assembly("\n".join(texts))
    points.data_layout = whole._codegen._data_layout
    whole._final_module.link_in(points)
    for defined in (*whole._final_module.functions, *whole._final_module.global_variables):
        if not defined.is_declaration and not defined.name.startswith(entry_points.PREFIX):
            defined.linkage = "internal"
    whole._optimize_final_module()
    whole._final_module.verify()
    return str(whole._final_module), stated
