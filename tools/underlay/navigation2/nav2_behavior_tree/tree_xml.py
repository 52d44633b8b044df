# SPDX-License-Identifier: Apache-2.0
"""Read the XML files of behavior trees, with line numbers and includes."""

from __future__ import annotations

from dataclasses import dataclass, field
import os
from pathlib import Path
from typing import Any
from xml.parsers import expat

from nav2_behavior_tree.status import TreeError

__all__ = ['Document', 'Element', 'read_tree_file', 'read_tree_text']


@dataclass
class Element:
    """An element of an XML file, and its location."""

    tag: str
    attributes: dict[str, str]
    file: str
    line: int
    children: list[Element] = field(default_factory=list)

    def error(self, message: str) -> TreeError:
        """
        Make an error that states the location of this element in its file.

        Parameters
        ----------
        message
            The error message, a full sentence.

        """
        return TreeError(message, self.file, self.line)


@dataclass
class Document:
    """The trees of a file and of its includes by their IDs, and the ID of the main tree."""

    trees: dict[str, Element]
    main: str
    file: str
    warnings: list[str] = field(default_factory=list)


def read_tree_file(path: str) -> Document:
    """
    Read the trees of a file, and of those that it includes.

    Parameters
    ----------
    path
        The XML file.

    Raises
    ------
    TreeError
        It cannot be read, or is invalid.

    """
    return read_tree_text(_text_of(path), path)


def read_tree_text(text: str, file: str = 'behavior tree') -> Document:
    """
    Read trees from an XML text, and from the files that it includes.

    Parameters
    ----------
    text
        The contents of an XML file.
    file
        Its name in errors; includes without `ros_pkg` are relative to its folder.

    Raises
    ------
    TreeError
        It is invalid.

    """
    root = _parse(text, file)
    if root.tag != 'root':
        raise root.error(f'The outermost element must be <root>, but is <{root.tag}>.')
    trees: dict[str, Element] = {}
    warnings: list[str] = []
    _collect(root, trees, warnings, {os.path.abspath(file)})
    if not trees:
        raise root.error('There is no <BehaviorTree> in <root>.')
    main = root.attributes.get('main_tree_to_execute', '')
    if not main:
        own = [key for key, tree in trees.items() if tree.file == file]
        if len(own) != 1:
            raise root.error(
                'There are several trees; say which one is the main one with the attribute '
                'main_tree_to_execute of <root>.'
            )
        main = own[0]
    if main not in trees:
        known = ', '.join(f"'{each}'" for each in trees)
        raise root.error(f"main_tree_to_execute is '{main}', but the trees are {known}.")
    return Document(trees, main, file, warnings)


def _text_of(path: str) -> str:
    try:
        return Path(path).read_text(encoding='utf-8')
    except (OSError, UnicodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else 'it is not UTF-8'
        raise TreeError(f"The behavior tree file '{path}' cannot be read: {reason}.") from error


def _collect(
    root: Element, trees: dict[str, Element], warnings: list[str], seen: set[str]
) -> None:
    version = root.attributes.get('BTCPP_format')
    if version is None:
        warnings.append(
            f'{root.file}:{root.line}: <root> has no BTCPP_format="4"; format 4 is assumed.'
        )
    elif version != '4':
        raise root.error(f"BTCPP_format is '{version}'; only format 4 can be read.")
    for child in root.children:
        if child.tag == 'include':
            _include(child, trees, warnings, seen)
        elif child.tag == 'BehaviorTree':
            _keep(child, trees)
        elif child.tag != 'TreeNodesModel':
            raise child.error(
                f'<{child.tag}> is not allowed in <root>; <BehaviorTree>, <include> and '
                '<TreeNodesModel> are.'
            )


def _keep(tree: Element, trees: dict[str, Element]) -> None:
    key = tree.attributes.get('ID', '') or 'BehaviorTree'
    if key in trees:
        raise tree.error(f"There are two trees with the ID '{key}'.")
    if len(tree.children) != 1:
        raise tree.error(
            f"The tree '{key}' needs exactly one node at its root, but has {len(tree.children)}."
        )
    trees[key] = tree


def _include(
    element: Element, trees: dict[str, Element], warnings: list[str], seen: set[str]
) -> None:
    path = element.attributes.get('path')
    if not path:
        raise element.error('<include> needs the attribute path.')
    package = element.attributes.get('ros_pkg')
    folder = os.path.dirname(os.path.abspath(element.file))
    if package:
        from ament_index_python.packages import (  # only if a file requires it
            get_package_share_directory,
            PackageNotFoundError,
        )

        try:
            folder = get_package_share_directory(package)
        except (PackageNotFoundError, ValueError) as error:
            raise element.error(f"There is no package '{package}'.") from error
    full = os.path.normpath(os.path.join(folder, path))
    if full in seen:
        return
    seen.add(full)
    try:
        text = _text_of(full)
    except TreeError as error:
        raise element.error(str(error)) from error
    _collect(_parse(text, full), trees, warnings, seen)


def _parse(text: str, file: str) -> Element:
    parser = expat.ParserCreate()
    stack: list[Element] = []
    roots: list[Element] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, file, parser.CurrentLineNumber)
        (stack[-1].children if stack else roots).append(element)
        stack.append(element)

    def end(_: str) -> None:
        stack.pop()

    handlers: Any = parser
    handlers.StartElementHandler, handlers.EndElementHandler = start, end
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        where = f' Look at <{stack[-1].tag}> from line {stack[-1].line}.' if stack else ''
        raise TreeError(f'This is not valid XML: {reason}.{where}', file, error.lineno) from error
    return roots[0]
