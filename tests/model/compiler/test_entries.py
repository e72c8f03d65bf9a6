"""Each entry, three ways: plain, by numba, and as the machine code that comes with the package; and what it refuses."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from qsbearing.model.compiler import library
from qsbearing.model.compiler.compiled import HAS_NUMBA, CompiledEntry
from qsbearing.model.compiler.kinds import Array, flat
from tests.model.compiler.recorded import arrays, copied, recorded
from tests.verification.kernel_library import inputs

ENTRIES = {entry.name: entry for entry in inputs.entries()}
every_entry = pytest.mark.parametrize("name", ENTRIES)
with_library = pytest.mark.skipif(library.found() is None, reason="there is no machine code for this platform")


@pytest.fixture(scope="module")
def calls() -> dict[str, list[tuple[Any, ...]]]:
    return recorded()


def outcome(run: Any, args: tuple[Any, ...]) -> tuple[Any, list[bytes]]:
    """What is returned, and every array as it is left."""
    own = copied(args)
    with np.errstate(all="ignore"):
        return run(*own), [part.tobytes() for each in arrays(own) for part in fields(each)]


def fields(of: NDArray) -> list[NDArray]:
    """Of records; between them there are bytes that mean nothing."""
    return [of[name] for name in of.dtype.names] if of.dtype.names else [of]


def assert_same(name: str, one: Any, other: Any, calls: list[tuple[Any, ...]]) -> None:
    assert calls, f"nothing calls {name}"
    for number, args in enumerate(calls):
        assert outcome(one, args) == outcome(other, args), f"call {number} of {name}"


def machine_code(entry: CompiledEntry) -> Any:
    found = library.machine_code(entry.name, entry.flat_kinds)
    assert found is not None, f"{entry.name} is not in the library"
    return found


@with_library
@every_entry
def test_machine_code_gives_the_digits_of_plain_python(name: str, calls: dict[str, list[tuple[Any, ...]]]) -> None:
    """Statuses and iterations of what is refused included."""
    assert_same(name, machine_code(ENTRIES[name]), ENTRIES[name].plain, calls.get(name, []))


@pytest.mark.heavy
@pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed, or switched off")
@every_entry
def test_numba_gives_the_digits_of_plain_python(
    name: str, calls: dict[str, list[tuple[Any, ...]]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("NUMBA_CACHE_DIR", str(tmp_path_factory.getbasetemp() / "numba"))
        compiled = ENTRIES[name].by_numba()
    assert_same(name, compiled, ENTRIES[name].plain, calls.get(name, []))
    assert len(compiled.signatures) == 1


def examples(kind: Any) -> Any:
    """What an argument of a kind may be."""
    return np.ones((2,) * kind.ndim, kind.dtype) if isinstance(kind, Array) else kind(1)


def of_other_kinds(kind: Any) -> dict[str, Any]:
    """What is near to a kind, and none of it."""
    if not isinstance(kind, Array):
        return {"text": "1", "array": np.ones(2)} | ({"float": 1.0} if kind is int else {})
    good = examples(kind)
    read_only = good.copy()
    read_only.flags.writeable = False
    spread = np.ones((*(2,) * (kind.ndim - 1), 4), kind.dtype)[..., ::2]
    plain = np.float32 if kind.dtype == np.float64 else np.float64
    narrower = np.ones(good.shape, plain)
    found = {"dtype": narrower, "dimension": good[None], "order": spread, "read-only": read_only, "list": good.tolist()}
    if kind.dtype.names:
        found["layout"] = np.ones(good.shape, np.dtype(kind.dtype.descr[:-1]))
    return found


@every_entry
def test_arguments_of_another_kind_are_refused(name: str) -> None:
    """Whichever way it runs: nothing is converted, and nothing compiled for them."""
    entry = ENTRIES[name]
    ways = [entry.plain, *([machine_code(entry)] if library.found() else [])]
    kinds = entry.flat_kinds
    for place, kind in enumerate(kinds):
        for what, other in of_other_kinds(kind).items():
            given = [other if k == place else examples(each) for k, each in enumerate(kinds)]
            for way in ways:
                with pytest.raises(TypeError):
                    way(*given)
                    pytest.fail(f"argument {place} of {name}: {what} is taken")
    with pytest.raises(TypeError, match="arguments; it takes"):
        entry.plain(*[examples(kind) for kind in kinds[1:]])


@with_library
def test_records_that_were_pickled_are_taken() -> None:
    """Their dtype is equal, not the same object."""
    import pickle

    import qsbearing as qs
    from qsbearing.model.kernel.solve_case import solve_cases
    from qsbearing.model.kernel.workspace import working_memory
    from qsbearing.model.solution.flatten import CaseMaker

    maker = CaseMaker(qs.load_scene("b218"))
    cases = pickle.loads(pickle.dumps(maker.make()))
    results = np.zeros(1, solve_cases.flat_kinds[7].dtype)  # type: ignore[attr-defined]
    given = (*working_memory(16), np.empty((1, 0), solve_cases.flat_kinds[3].dtype), 1e-12, 100, False)  # type: ignore[attr-defined]
    assert solve_cases(cases, *given, results, np.zeros((1, 16, 3)), np.zeros((1, 16), np.int8)) == 0
    assert results["iterations"] == qs.solve(maker.scene).iterations


def test_flat_kinds_are_of_flat_arguments() -> None:
    assert list(flat([1, (2, (3,), 4), 5])) == [1, 2, 3, 4, 5]
