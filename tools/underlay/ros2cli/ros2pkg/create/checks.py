# SPDX-License-Identifier: Apache-2.0
"""Validation of a package to create, with remedies."""

from __future__ import annotations

import argparse
import keyword
import os
import re
import sys


def refusal(args: argparse.Namespace, package_folder: str) -> str:
    """
    Check whether a package can be created.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line of `ros2 pkg create`.
    package_folder
        The folder of the package, which must not exist yet.

    Returns
    -------
    str
        The error message with the remedy, or '' if nothing is wrong.

    """
    if os.path.isdir(package_folder):
        return (
            f'\nAborted!\nThe directory already exists: {package_folder}\nEither remove the '
            'directory or choose a different destination directory or package name'
        )
    if os.sep in args.package_name:
        return (
            f"'{args.package_name}' is a path and no name of a package. Give the folder in which "
            'to create the package with --destination-directory.'
        )
    if not re.fullmatch(r'[A-Za-z][A-Za-z0-9_-]*', args.package_name):
        return (
            f"'{args.package_name}' is no name of a package: use letters, digits and underscores, "
            f"with a letter first, for example '{_better_name(args.package_name)}'."
        )
    if args.build_type == 'cmake':
        return (
            "The build type 'cmake' is not supported here. Choose --build-type ament_python "
            'for a Python package, or --build-type ament_cmake for a C++ package.'
        )
    return _python_refusal(args) if args.build_type == 'ament_python' else _cmake_refusal(args)


def _cmake_refusal(args: argparse.Namespace) -> str:
    if args.library_name:
        return (
            '--library-name is supported only for Python packages here. Add '
            '--build-type ament_python, or leave --library-name out.'
        )
    return ''


def _python_refusal(args: argparse.Namespace) -> str:
    if args.package_name == 'test':
        return (
            "A package of the build type 'ament_python' cannot be named 'test', because its "
            'folder of tests has this name already. Please choose a different package name.'
        )
    names = {
        'package': args.package_name,
        '--node-name': args.node_name,
        '--library-name': args.library_name,
    }
    problems = (_module_problem(what, name) for what, name in names.items() if name)
    return next(filter(None, problems), '')


def _module_problem(what: str, name: str) -> str:
    """Check whether a name is valid for a Python module; return the problem, or ''."""
    if not name.isidentifier():
        return (
            f"{what} '{name}' is no name of a Python module: use letters, digits and underscores "
            f"only, for example '{_better_name(name)}'."
        )
    if keyword.iskeyword(name):
        why = f"'{name}' is a word of the language Python, so that nobody could import it"
    elif what == 'package' and name in sys.stdlib_module_names:
        why = f"Python has a module '{name}' of its own, which is imported instead"
    else:
        return ''
    return f"{what} '{name}' cannot be: {why}. Choose another name, for example 'my_{name}'."


def _better_name(name: str) -> str:
    """Convert a name to a similar one of letters, digits and underscores."""
    return re.sub(r'^(?![A-Za-z])', 'n', re.sub(r'[^A-Za-z0-9_]', '_', name))


def renamed_node(node_name: str | None, library_name: str | None) -> str | None:
    """
    Rename a node that has the same name as the library, with a warning on stderr.

    Parameters
    ----------
    node_name, library_name
        As given on the command line; None if left out.

    Returns
    -------
    str or None
        The node's name, with `_node` appended if it had to be changed.

    """
    if not node_name or node_name != library_name:
        return node_name
    print(
        '[WARNING] node name can not be equal to the library name\n'
        f'[WARNING] renaming node to {node_name}_node',
        file=sys.stderr,
    )
    return f'{node_name}_node'
