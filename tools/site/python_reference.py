# SPDX-License-Identifier: Apache-2.0
"""Pages that describe the public Python modules of packages, from their sources alone."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import re
import textwrap
from typing import Any

import griffe

__all__ = ['python_page']

_LONGEST_VALUE = 60
_CODE = re.compile(r'(^ {4}.*$|`+[^`]+`+)', flags=re.MULTILINE)
_STARS = {'variadic positional': '*', 'variadic keyword': '**'}
_KEYWORD_ONLY = 'keyword-only'


def python_page(package: str, folder: Path, root: Path) -> str:
    """
    Describe the public names of a package's public modules.

    Parameters
    ----------
    package
        Its import name.
    folder
        The folder that contains it.
    root
        The workspace, by which the page names files.

    Returns
    -------
    str
        The page in Markdown, with directives of Sphinx's domain for Python.

    """
    top = griffe.load(
        package, search_paths=[folder], docstring_parser='numpy', allow_inspection=False
    )
    lines = [f'# {package}', '']
    for module in _modules(top):
        members = [text for each in _defined(module) for text in (*_member(each), '')]
        offers = _offers(module)
        if not (members or offers or module.docstring):
            continue
        if module is not top:
            lines += [f'## {module.path.removeprefix(f"{package}.")}', '']
        source = Path(str(module.filepath)).relative_to(root).as_posix()
        lines += [f':::{{py:module}} {module.path}', ':::', '']
        lines += [f'`{source}`', '', *_docstring(module), *offers, *members]
    return '\n'.join(lines) + '\n'


def _modules(module: griffe.Module) -> Iterator[griffe.Module]:
    """Yield a module and all public ones in it, in the order of their names."""
    yield module
    for name in sorted(module.modules):
        if not name.startswith('_') and name != 'test':
            yield from _modules(module.modules[name])


def _public(thing: Any) -> list[Any]:
    """Return the members with public names: of a module, those in `__all__` if there is one."""
    exports = thing.exports if thing.is_module else None
    return [
        member
        for name, member in thing.members.items()
        if (not name.startswith('_') if exports is None else name in exports)
    ]


def _defined(thing: Any) -> list[Any]:
    """Return what a module or class defines itself, in the order of the source."""
    members = [each for each in _public(thing) if not each.is_alias and not each.is_module]
    return sorted(members, key=lambda each: each.lineno or 0)


def _offers(module: griffe.Module) -> list[str]:
    """Say which names of other modules are to be imported from this one."""
    if module.exports is None:
        return []
    links = [f'{{py:obj}}`{x.name} <{x.target_path}>`' for x in _public(module) if x.is_alias]
    return [f'Import from here: {", ".join(links)}.', ''] if links else []


def _member(member: Any) -> Iterator[str]:
    """Describe a class, function or variable as a directive, which contains its own members."""
    options = [f':module: {member.module.path}']
    contents = [*_docstring(member)]
    name = member.path.removeprefix(f'{member.module.path}.')
    if member.is_class:
        directive, name = 'class', name + _parameters(member)
        for each in _defined(member):
            if each.docstring or not (each.is_attribute and _is_obvious(each)):
                contents += ['', *_member(each)]
    elif member.is_function:
        directive = 'method' if member.parent.is_class else 'function'
        returns = f' -> {_qualified(member.returns)}' if member.returns else ''
        name += _parameters(member) + returns
        flags = {'async', 'classmethod', 'staticmethod', 'abstractmethod'} & member.labels
        options += [f':{flag}:' for flag in sorted(flags)]
    else:
        is_property = 'property' in member.labels
        of_class = 'property' if is_property else 'attribute'
        directive = of_class if member.parent.is_class else 'data'
        if member.annotation is not None:
            options.append(f':type: {_qualified(member.annotation)}')
        value = ' '.join(str(member.value or '').split())
        if value and not is_property and len(value) <= _LONGEST_VALUE:
            options.append(f':value: {value}')
    fence = ':' * max(3, *(len(line) - len(line.lstrip(':')) + 1 for line in ('::', *contents)))
    yield from (f'{fence}{{py:{directive}}} {name}', *options, '', *contents, fence)


def _is_obvious(attribute: Any) -> bool:
    """Whether an attribute without a docstring is a field of a dataclass or set by a method."""
    return 'dataclass' in attribute.parent.labels or 'class-attribute' not in attribute.labels


def _parameters(member: Any) -> str:
    """Format the parameters of a function or class; nothing for a class that names none."""
    parameters = [each for each in member.parameters if each.name not in ('self', 'cls')]
    if member.is_class and not parameters:
        return ''
    texts = []
    after_star = False
    for each in parameters:
        kind = each.kind.value if each.kind else ''
        if kind == _KEYWORD_ONLY and not after_star:
            texts.append('*')
        after_star = after_star or kind in (_KEYWORD_ONLY, 'variadic positional')
        text = _STARS.get(kind, '') + each.name
        text += f': {_qualified(each.annotation)}' if each.annotation else ''
        if each.default is not None and kind not in _STARS:
            text += f' = {" ".join(str(each.default).split())}'
        texts.append(text)
    return f'({", ".join(texts)})'


def _qualified(annotation: Any) -> str:
    """Format an annotation with the full names of types, by which Sphinx finds them."""
    if isinstance(annotation, str):
        return annotation
    if isinstance(annotation, (griffe.ExprName, griffe.ExprAttribute)):
        return str(annotation.canonical_path)
    return ''.join(_qualified(part) for part in annotation.iterate(flat=False))


def _docstring(thing: Any) -> Iterator[str]:
    """Render a docstring as Markdown, and its sections as fields."""
    for section in thing.docstring.parsed if thing.docstring else ():
        kind = section.kind.value
        if kind == 'text':
            yield from (*_prose(section.value).splitlines(), '')
            continue
        if kind == 'admonition':  # such as Notes and References
            yield from (f'**{section.title}**', '')
            yield from (*_prose(section.value.contents).splitlines(), '')
            continue
        for entry in section.value:
            yield from _entry(kind, entry)
        yield ''


def _entry(kind: str, entry: Any) -> list[str]:
    """Render an entry of a section, such as a parameter."""
    text = _prose(entry.description)
    if kind in ('parameters', 'other parameters'):
        start = f':param {entry.name}: '
    elif kind == 'attributes':
        start = f'- `{entry.name}`: '
    elif kind == 'raises':
        start = f':raises {_qualified(entry.annotation)}: '
    else:
        start, result = f':{kind}: ', str(entry.annotation or entry.name or '')
        text = f'*{result}*: {text}' if text and result else text or result
    return (start.replace('*', '\\*') + textwrap.indent(text, '  ').lstrip()).splitlines()


def _prose(text: str) -> str:
    """Escape what Markdown would take for HTML, outside code."""
    parts = _CODE.split(text.strip())
    parts[::2] = [part.replace('<', '&lt;') for part in parts[::2]]
    return ''.join(parts)
