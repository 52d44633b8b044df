# SPDX-License-Identifier: Apache-2.0
"""Reconstruct the state of xacro at an error from the frames of its traceback."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import FrameType
from typing import Any, NamedTuple, Optional

import xacro
from xacro_program.placed_document import BrokenXmlError, Place, place_of, PlacedText

_LISTED = 8


class Step(NamedTuple):
    """A step of the expansion: an include, a macro call or the use of a property."""

    what: str
    place: Optional[Place]

    def __str__(self) -> str:
        return f'{self.what} at {self.place}'


class Trail:
    """
    Trace of the expansion that led to an error.

    Parameters
    ----------
    error
        The exception that xacro raised; its traceback and those of the exceptions in its
        context are analysed.

    Attributes
    ----------
    place
        The element or attribute that was being expanded last; None if unknown.
    code
        The expression that failed, such as `${x}`; empty if there is none.
    in_tag
        Whether the expression is in the tag of the element, not below it.
    symbols, macros
        The symbol tables at that place.
    macro
        The macro that was being called last; None if there is none.

    """

    def __init__(self, error: BaseException) -> None:
        self.place: Optional[Place] = None
        self.code = ''
        self.in_tag = True
        self.symbols: Mapping[str, Any] = {}
        self.macros: Mapping[str, Any] = {}
        self.macro: Any = None
        self._steps: list[Step] = []
        for frame in _frames(error):
            follow = getattr(self, f'_in_{frame.f_code.co_name.strip("_")}', None)
            if follow is not None:
                follow(frame.f_locals)
        root = root_of(error)
        if isinstance(root, BrokenXmlError):
            self.place = root.place

    def exact_place(self) -> Optional[Place]:
        """Return the place of the failing expression if known, else of its element."""
        if self.place is None or not self.code:
            return self.place
        return self.place.of(self.code, self.in_tag)

    def steps(self) -> list[str]:
        """Return the steps that led to the place, most recent first."""
        steps = [step for step in self._steps if step.place is not None]
        if steps and steps[-1].place == self.place:
            steps.pop()
        texts = list(dict.fromkeys(str(step) for step in reversed(steps)))
        more = len(texts) - _LISTED
        return [*texts[:_LISTED], f'and {more} more'] if more > 1 else texts

    def _in_eval_all(self, names: Mapping[str, Any]) -> None:
        node = names['node']
        self.place = place_of(node) or self.place
        self.in_tag = node is None or node.nodeType == node.ELEMENT_NODE
        self.code = ''
        self.symbols, self.macros = names['symbols'], names['macros']

    def _in_process_include(self, names: Mapping[str, Any]) -> None:
        if 'filename' in names:
            self._steps.append(Step('included', place_of(names['elt'])))

    def _in_handle_macro_call(self, names: Mapping[str, Any]) -> None:
        self.macro = names.get('m')
        if 'block' in names:
            name = self.macro.body.getAttribute('name')
            self._steps.append(Step(f"in macro '{name}', called", place_of(names['node'])))

    def _in_eval_default_arg(self, names: Mapping[str, Any]) -> None:
        self.place = place_of(names['macro'].body)

    def _in_resolve(self, names: Mapping[str, Any]) -> None:
        if 'key' in names:
            self._steps.append(Step(f"in property '{names['key']}', used", self.place))

    def _in_eval_text(self, names: Mapping[str, Any]) -> None:
        self.symbols = names['symbols']
        if isinstance(names['text'], PlacedText):
            self.place, self.in_tag, self.code = names['text'].place, True, ''

    def _in_handle_expr(self, names: Mapping[str, Any]) -> None:
        self.code = f'${{{names["s"]}}}'

    def _in_handle_extension(self, names: Mapping[str, Any]) -> None:
        self.code = f'$({names["s"]})'


def root_of(error: BaseException) -> BaseException:
    """
    Return the original error, which xacro may have wrapped several times.

    Parameters
    ----------
    error
        The exception that xacro raised.

    """
    while isinstance(error, xacro.XacroException) and error.exc is not None:
        error = error.exc
    return error


def _frames(error: Optional[BaseException]) -> Iterator[FrameType]:
    """Yield the stack frames of xacro, outermost first."""
    last = None
    while error is not None:
        traceback = error.__traceback__
        while traceback is not None:
            frame, traceback = traceback.tb_frame, traceback.tb_next
            if frame.f_globals.get('__name__') == 'xacro' and frame is not last:
                last = frame
                yield frame
        error = error.__context__
