# SPDX-License-Identifier: Apache-2.0
"""Measures the structure of the packages: their sizes, and how their modules import each other.

`python3 tools/reference/figures.py` prints a table of all packages, `figures.py NAME ...` of some.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
import statistics
import sys

from graphs import chain, circles

ROOT = Path(__file__).resolve().parents[2]
PLACES = ('src', 'tools/underlay')
COLUMNS = (
    'package',
    'modules',
    'lines',
    'lines of a module (median, most)',
    'lines of a function (median, 9 in 10, most)',
    'longest class',
    'one importer',
    'chain',
    'circle',
    'foreign private names',
    'private imports',
)
# Public by the documentation of the standard library, in spite of their underscores.
DOCUMENTED = {'os._exit', '_thread.interrupt_main'}
OF_NAMED_TUPLES = {'_asdict', '_field_defaults', '_fields', '_make', '_replace'}
# The functions that reach an attribute by its name as text.
BY_TEXT = {'delattr', 'getattr', 'hasattr', 'setattr'}
Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Module:
    """A Python module and what can be read from its text."""

    name: str
    """Its name with dots, as it is imported."""
    path: Path
    text: str

    @cached_property
    def tree(self) -> ast.Module:
        """The syntax tree."""
        return ast.parse(self.text)

    @property
    def is_package(self) -> bool:
        """Whether this is the `__init__` of a package."""
        return self.path.name == '__init__.py'

    @property
    def lines(self) -> int:
        """Number of lines, with comments and blank ones."""
        return self.text.count('\n')

    @property
    def functions(self) -> list[Function]:
        """All functions, also those of classes and of other functions."""
        return [node for node in ast.walk(self.tree) if isinstance(node, Function)]

    @property
    def classes(self) -> list[ast.ClassDef]:
        """All classes."""
        return [node for node in ast.walk(self.tree) if isinstance(node, ast.ClassDef)]

    def imported(self) -> Iterator[str]:
        """Yield the names, with dots, of the modules that this one imports, or of things in them.

        Imports in functions, and those for types only, count as well.
        """
        for node in ast.walk(self.tree):
            if isinstance(node, ast.Import):
                yield from (alias.name for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                start = self._package()
                start = start[: len(start) - node.level + 1] if node.level else []
                base = '.'.join([*start, *([node.module] if node.module else [])])
                yield from (f'{base}.{alias.name}' for alias in node.names)

    def _package(self) -> list[str]:
        """Return the parts of the name of the package that relative imports begin at."""
        parts = self.name.split('.')
        return parts if self.is_package else parts[:-1]


def modules(folder: Path) -> dict[str, Module]:
    """Read the modules of a package, without its tests, launch files and `setup.py`.

    Parameters
    ----------
    folder : Path
        Folder with the package's manifest.

    Returns
    -------
    dict of str to Module
        The modules by their names with dots.

    """
    found = {}
    for path in sorted(folder.rglob('*.py')):
        parts = path.relative_to(folder).with_suffix('').parts
        if 'test' in parts or path.name == 'setup.py' or path.name.endswith('.launch.py'):
            continue
        top = path.parent
        while (top / '__init__.py').exists():
            top = top.parent
        parts = path.relative_to(top).with_suffix('').parts
        name = '.'.join(parts[:-1] if parts[-1] == '__init__' else parts)
        found[name] = Module(name, path, path.read_text())
    return found


def packages() -> dict[str, Path]:
    """Return the folders of all packages by their names."""
    manifests = [each for place in PLACES for each in (ROOT / place).glob('*/package.xml')]
    return {path.parent.name: path.parent for path in sorted(manifests)}


def top_names() -> set[str]:
    """Return the names of the top-level packages that can be imported from all packages."""
    return {each.name for path in packages().values() for each in path.iterdir() if each.is_dir()}


def imports(these: dict[str, Module]) -> dict[str, set[str]]:
    """Return which modules import which others.

    Parameters
    ----------
    these : dict of str to Module
        The modules that count, by their names.

    Returns
    -------
    dict of str to set of str
        For each module, the others that it imports.

    """
    found: dict[str, set[str]] = {}
    for name, module in these.items():
        wanted = set(module.imported())
        known = {each if each in these else each.rpartition('.')[0] for each in wanted}
        found[name] = known & these.keys() - {name}
    return found


def foreign_private_names(module: Module) -> list[str]:
    """Return the accesses to private attributes of other objects.

    Parameters
    ----------
    module : Module
        The module to read.

    Returns
    -------
    list of str
        As `line: expression`, also of attributes that `getattr` and its like name as text, without
        those of `self`, `cls` and the class itself, and without documented ones.

    """
    own = {'self', 'cls', *(each.name for each in module.classes)}
    found = []
    for node in ast.walk(module.tree):
        reached = _reached(node)
        if reached is None:
            continue
        owner, name = reached
        if not _is_private(name) or name in OF_NAMED_TUPLES or f'{owner}.{name}' in DOCUMENTED:
            continue
        if owner not in own and owner != 'super()':
            found.append(f'{node.lineno}: {ast.unparse(node)}')
    return found


def _reached(node: ast.AST) -> tuple[str, str] | None:
    """Return the object and the name of the attribute that an expression reaches, if it does."""
    match node:
        case ast.Attribute(owner, name):
            return ast.unparse(owner), name
        case ast.Call(ast.Name(function), [owner, ast.Constant(str(name)), *_]):
            return (ast.unparse(owner), name) if function in BY_TEXT else None
    return None


def _is_private(name: str) -> bool:
    """Return whether an underscore says that a name is private; those of Python are not."""
    return name.startswith('_') and not name.endswith('__')


def private_imports(these: dict[str, Module], of: Container[str] | None = None) -> list[str]:
    """Return the imports of private modules and names of other packages and of libraries.

    Parameters
    ----------
    these : dict of str to Module
        The modules that import; what is private in their own top-level packages does not count.
    of : container of str
        The top-level packages whose private parts count; if None, all.

    Returns
    -------
    list of str
        As `module: what it imports`, without documented ones.

    """
    own = {name.partition('.')[0] for name in these}
    return [
        f'{name}: {each}'
        for name, module in these.items()
        for each in sorted(set(module.imported()) - DOCUMENTED)
        if (top := each.partition('.')[0]) not in own
        and (of is None or top in of)
        and any(map(_is_private, each.split('.')))
    ]


def row(name: str, these: dict[str, Module]) -> list[str]:
    """Return the figures of a package.

    Parameters
    ----------
    name : str
        What stands in the first column.
    these : dict of str to Module
        The modules of the package.

    Returns
    -------
    list of str
        A text for each of `COLUMNS`.

    """
    with_code = [each for each in these.values() if not _only_exports(each)]
    graph = imports(these)
    importers = Counter(other for each in graph.values() for other in each)
    functions = sorted(_length(each) for module in with_code for each in module.functions)
    classes = [_length(each) for module in with_code for each in module.classes]
    lines = [each.lines for each in with_code]
    alone = sum(importers[each.name] == 1 for each in with_code) / max(len(with_code), 1)
    return [
        name,
        str(len(with_code)),
        str(sum(lines)),
        f'{_median(lines)}, {max(lines, default=0)}',
        f'{_median(functions)}, {_share(functions, 0.9)}, {max(functions, default=0)}',
        str(max(classes, default=0)),
        f'{alone:.0%}',
        str(len(chain(graph))),
        str(max(map(len, circles(graph)), default=0)),
        str(sum(len(foreign_private_names(each)) for each in with_code)),
        str(len(private_imports(these))),
    ]


def _only_exports(module: Module) -> bool:
    """Return whether a module is an `__init__` that says only what its package offers."""
    return module.is_package and not module.functions and not module.classes


def _length(node: Function | ast.ClassDef) -> int:
    """Return the number of lines of a function or class."""
    return (node.end_lineno or node.lineno) - node.lineno + 1


def _median(values: Sequence[int]) -> int:
    """Return the median, 0 if there is no value."""
    return round(statistics.median(values)) if values else 0


def _share(values: Sequence[int], share: float) -> int:
    """Return the value below which a share of sorted values lies, 0 if there is none."""
    return values[int(share * (len(values) - 1))] if values else 0


def main(names: Sequence[str]) -> int:
    """Print the figures of packages.

    Parameters
    ----------
    names : sequence of str
        The packages; all if there is none.

    Returns
    -------
    int
        Exit status: 0, or 2 if there is no such package.

    """
    folders = packages()
    unknown = sorted(set(names) - folders.keys())
    if unknown:
        print(f'No such package: {", ".join(unknown)}. There are {", ".join(folders)}.')
        return 2
    chosen = {name: modules(folders[name]) for name in names or folders}
    rows = [list(COLUMNS), ['---'] * len(COLUMNS)]
    rows += [row(name, these) for name, these in chosen.items() if these]
    if len(chosen) > 1:
        rows.append(
            row('all', {key: value for each in chosen.values() for key, value in each.items()})
        )
    for each in rows:
        print('|', ' | '.join(each), '|')
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
