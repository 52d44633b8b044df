# SPDX-License-Identifier: Apache-2.0
"""
Report errors of xacro with their location, cause, a suggestion, and trace.

What xacro was doing is reconstructed from the frames of the traceback.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
import os
import re
from types import FrameType
from typing import Any, NamedTuple, Optional

from ros_environment.suggestions import did_you_mean
import xacro
from xacro_program.placed_document import BrokenXmlError, Place, place_of, PlacedText

_LISTED = 8
_TAGS = 'arg attribute call element if include insert_block macro property unless'.split()
_NAMESPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def report(error: BaseException, path: str) -> str:
    """
    Format an error in the expansion of a file: its location, cause and trace.

    Parameters
    ----------
    error
        The exception that xacro raised.
    path
        The file that is expanded, for errors without a location.

    """
    trail = Trail(error)
    place = trail.exact_place()
    where = f'{place.file}:{place.line}:{place.column}' if place else path
    is_intended = trail.code.startswith('${xacro.fatal(')
    code = f'in {trail.code}: ' if trail.code and not is_intended else ''
    first = f'{where}: error: {code}{_explain(error, trail)}'
    return '\n'.join([first, *(f'  {step}' for step in trail.steps())])


def _explain(error: BaseException, trail: Trail) -> str:
    """
    Explain the cause of an error, with a suggestion if available.

    Parameters
    ----------
    error
        The exception that xacro raised.
    trail
        The state of xacro at the time of the error.

    """
    root = root_of(error)
    for kind, explanation in _BY_TYPE.items():
        if type(root).__name__ == kind:
            return explanation(root, trail)
    if isinstance(root, OSError):
        return _unreadable(root)
    text = ', '.join(line.strip() for line in str(root).splitlines()).rstrip('.')
    for pattern, advice in _BY_TEXT:
        match = pattern.match(text)
        if match:
            return _join(text, advice(match, trail))
    says_enough = isinstance(root, (ArithmeticError, RuntimeError))
    if says_enough or type(root).__module__.startswith('xacro'):
        return text
    return f'{type(root).__name__}: {text}'


def _join(sentence: str, advice: str) -> str:
    return f'{sentence}. {advice}' if advice else sentence


def _broken_xml(error: BrokenXmlError, trail: Trail) -> str:
    """Explain why XML is not well-formed."""
    text = f'broken XML: {error.reason}'
    if error.reason == 'unbound prefix':
        return f'{text}. Declare the prefix before the colon in the first element: {_NAMESPACE}'
    is_unclosed = error.reason in ('mismatched tag', 'no element found')
    return f'{text}; {error.inside} is still open' if error.inside and is_unclosed else text


def _missing_package(error: BaseException, trail: Trail) -> str:
    found = re.match(r"package '(.*?)' not found", str(error.args[0]))
    from ros_environment.workspace import explain_missing_package

    package = found[1] if found else str(error.args[0])
    return _join(f"there is no package '{package}'", explain_missing_package(package))


def _missing_argument(error: BaseException, trail: Trail) -> str:
    known = xacro.substitution_args_context['arg']
    name = str(error)
    return _join(
        f"the argument '{name}' is neither declared nor given",
        did_you_mean(name, known) or f'Declare it: <xacro:arg name="{name}" default="..."/>',
    )


def _endless(error: BaseException, trail: Trail) -> str:
    return 'infinite recursion of macros or includes'


def _missing_key(error: BaseException, trail: Trail) -> str:
    return f'there is no {error}'


def _bad_syntax(error: SyntaxError, trail: Trail) -> str:
    """Explain a syntax error in a Python expression."""
    if '{' in trail.code[2:]:
        return f'{error.msg}. An expression ends at the first }}: write dict(a=1) for {{...}}'
    return str(error.msg)


def _unreadable(error: OSError) -> str:
    """Explain why a file cannot be read."""
    path = os.path.normpath(error.filename or '')
    if not isinstance(error, FileNotFoundError):
        return f"'{path}' cannot be read: {error.strerror}"
    from ros_environment.missing_file import explain_missing_file

    return explain_missing_file('file', path)


def _of_symbols(match: re.Match[str], trail: Trail) -> str:
    return did_you_mean(match[1], _names(trail.symbols))


def _of_macros(match: re.Match[str], trail: Trail) -> str:
    close = did_you_mean(match[1], [*_names(trail.macros), *_TAGS])
    return close.replace("'", "'xacro:", 1)


def _of_blocks(match: re.Match[str], trail: Trail) -> str:
    names = _names(trail.symbols)
    return did_you_mean(match[1], [name.lstrip('*') for name in names if name.startswith('*')])


def _of_parameters(match: re.Match[str], trail: Trail) -> str:
    name = trail.macro.body.getAttribute('name')
    parameters = trail.macro.params
    listing = f"The macro '{name}' takes: {', '.join(parameters) or 'nothing'}"
    return did_you_mean(match[1], parameters) or listing


def _needed(match: re.Match[str], trail: Trail) -> str:
    name = trail.macro.body.getAttribute('name')
    return f"The macro '{name}' needs: {match[1].replace(',', ', ')}"


def _taken_blocks(match: re.Match[str], trail: Trail) -> str:
    name = trail.macro.body.getAttribute('name')
    blocks = [param for param in trail.macro.params if param.startswith('*')]
    return f"The macro '{name}' takes as child elements: {', '.join(blocks) or 'nothing'}"


def _names(table: object) -> Iterable[str]:
    """Return the names in a symbol table of xacro and in its parents."""
    names: list[str] = []
    while isinstance(table, dict):
        names += [str(name) for name in table]
        table = getattr(table, 'parent', None)
    return names


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


_BY_TYPE: dict[str, Callable[..., str]] = {
    'ArgException': _missing_argument,
    'BrokenXmlError': _broken_xml,
    'KeyError': _missing_key,
    'PackageNotFoundError': _missing_package,
    'RecursionError': _endless,
    'SyntaxError': _bad_syntax,
}
_BY_TEXT: list[tuple[re.Pattern[str], Callable[[re.Match[str], Trail], str]]] = [
    (re.compile(r"name '(\w+)' is not defined"), _of_symbols),
    (re.compile(r'unknown macro name: xacro:(.*)'), _of_macros),
    (re.compile(r'Undefined block "(.*)"'), _of_blocks),
    (re.compile('Not enough blocks|Unused block'), _taken_blocks),
    (re.compile(r'Invalid parameter "(.*)"'), _of_parameters),
    (re.compile(r'Undefined parameters \[(.*)\]'), _needed),
]
