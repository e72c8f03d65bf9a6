"""Errors are data until they are printed: fields within a sentence are named, and spelled by whoever prints it."""

from __future__ import annotations

import ast
import pickle
from pathlib import Path

import qsbearing as qs
from qsbearing.files.file_errors import translate
from qsbearing.model.validation import ErrorDetail, Field, Sentence
from tests.qsbearing.source_text import trees


def test_words_of_a_sentence_are_no_keys() -> None:
    """A field that a sentence names is told as the file's key; the same word in a sentence stays a word."""
    names = {"own": Field("rigid"), "whole": Field("preload.spring"), "other": Field("operation.axial_load")}
    cause = Sentence("Give {own}, {whole} or {other}, not a spring axial_load", **names)
    error = ErrorDetail("preload.spring", "is less than the spring allows", cause=cause)
    told = "Give rigid_N, preload.spring_N or operation.axial_load_N, not a spring axial_load"
    assert str(translate(error)) == f"preload.spring_N: is less than the spring allows\n    {told}"
    assert str(error).endswith("Give rigid, preload.spring or operation.axial_load, not a spring axial_load")
    assert pickle.loads(pickle.dumps(error)) == error


def test_no_text_of_an_error_is_taken_apart() -> None:
    """Errors are data until they are printed: outside `documents/` nothing is searched or replaced in their text."""
    methods = {"replace", "split", "rsplit", "splitlines", "partition", "rpartition", "startswith", "endswith", "sub"}
    methods |= {"removeprefix", "removesuffix", "search", "match", "fullmatch", "findall", "finditer", "strip"}
    texts = {"problem", "cause", "detail"}
    root = Path(qs.__file__).parent
    found = []
    for file, tree in trees("|".join(texts), root):
        if file.parent.name == "documents":
            continue
        for call in ast.walk(tree):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr in methods:
                given = [node for part in (call.func.value, *call.args) for node in ast.walk(part)]
                words = {node.attr for node in given if isinstance(node, ast.Attribute)}
                words |= {node.id for node in given if isinstance(node, ast.Name)}
                found += [f"{file.relative_to(root)}:{call.lineno}"] if words & texts else []
    assert found == []
