# SPDX-License-Identifier: Apache-2.0
"""Report errors of xacro with their location, cause, a suggestion, and trace."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import os
import re

from ros_environment.suggestions import did_you_mean
import xacro
from xacro_program.placed_document import BrokenXmlError
from xacro_program.trail import root_of, Trail

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
    return 'macros or includes call themselves without end'


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
