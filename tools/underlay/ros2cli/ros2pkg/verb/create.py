# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 pkg create`, and what it refuses to create."""

from __future__ import annotations

import argparse
import getpass
import keyword
import os
import re
import subprocess
import sys

from ros2pkg.create.build_types import create_package
from ros2pkg.create.package import known_licenses, PackageDescription, unknown_license_warning
from ros2pkg.verb import VerbExtension

MISSING_NAME = (
    'the following arguments are required: package_name (give it before --dependencies, which '
    'takes all names that follow: {} --build-type ament_python my_package --dependencies rclpy)'
)


class CreateVerb(VerbExtension):
    """Create a new ROS 2 package."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the package and the options for its properties.

        Parameters
        ----------
        parser
            The parser of the verb, kept for usage errors that `main` finds.
        cli_name
            The words that call the verb, `ros2 pkg create`, kept for the same.

        """
        self._parser, self._cli_name = parser, cli_name
        add = parser.add_argument
        add('package_name', nargs='?', help='The package name')
        add(
            '--package-format',
            '--package_format',
            type=int,
            default=3,
            choices=[2, 3],
            help='The package.xml format',
        )
        add(
            '--description',
            default='TODO: Package description',
            help='The description given in the package.xml',
        )
        add(
            '--license',
            default='TODO: License declaration',
            help='The license attached to this package; this can be an arbitrary string, but '
            'a LICENSE file will only be generated if it is one of the supported licenses '
            "(pass '?' to get a list)",
        )
        add(
            '--destination-directory',
            default=os.curdir,
            help='Directory where to create the package directory',
        )
        add(
            '--build-type',
            default='ament_cmake',
            choices=['cmake', 'ament_cmake', 'ament_python'],
            help='The build type to process the package with',
        )
        add('--dependencies', nargs='+', default=[], help='list of dependencies')
        add('--maintainer-email', help='email address of the maintainer of this package')
        add(
            '--maintainer-name',
            default=getpass.getuser(),
            help='name of the maintainer of this package',
        )
        add('--node-name', help='name of the empty executable')
        add('--library-name', help='name of the empty library')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Create the package, or list the known licences for `--license ?`.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        int or str
            0, or the error message if the package cannot be created.

        """
        if args.license == '?':
            print('\n'.join(['Supported licenses:', *known_licenses()]))
            return 0
        if not args.package_name:
            self._parser.error(MISSING_NAME.format(self._cli_name))
        folder = os.path.join(args.destination_directory, args.package_name)
        problem = _refusal(args, folder)
        if problem:
            return problem
        args.node_name = _renamed_node(args.node_name, args.library_name)
        description = _description(args)
        print('going to create a new package')
        print(description.summary(os.path.abspath(args.destination_directory)))
        try:
            create_package(description, folder)
        except OSError as error:
            if error.filename is None:
                raise
            return f"cannot create '{error.filename}': {error.strerror}"
        if args.license not in known_licenses():
            print(unknown_license_warning(args.license))
        return 0


def _description(args: argparse.Namespace) -> PackageDescription:
    return PackageDescription(
        name=args.package_name,
        package_format=args.package_format,
        build_type=args.build_type,
        description=args.description,
        license_id=args.license,
        maintainer_name=args.maintainer_name,
        maintainer_email=args.maintainer_email or _default_email(args.maintainer_name),
        dependencies=tuple(args.dependencies),
        node_name=args.node_name,
        library_name=args.library_name,
    )


def _refusal(args: argparse.Namespace, package_folder: str) -> str:
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
            f"'{args.package_name}' is a path, not a package name. Give the folder in which "
            'to create the package with --destination-directory.'
        )
    if not re.fullmatch(r'[A-Za-z][A-Za-z0-9_-]*', args.package_name):
        return (
            f"'{args.package_name}' is not a valid package name: use letters, digits and "
            f"underscores, with a letter first, for example '{_better_name(args.package_name)}'."
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
            f"{what} '{name}' is not a valid Python module name: use letters, digits and "
            f"underscores only, for example '{_better_name(name)}'."
        )
    if keyword.iskeyword(name):
        why = f"'{name}' is a Python keyword, so it could not be imported"
    elif what == 'package' and name in sys.stdlib_module_names:
        why = f"Python has a module '{name}' of its own, which is imported instead"
    else:
        return ''
    return f"{what} '{name}' cannot be used: {why}. Choose another name, for example 'my_{name}'."


def _better_name(name: str) -> str:
    """Convert a name to a similar one of letters, digits and underscores."""
    return re.sub(r'^(?![A-Za-z])', 'n', re.sub(r'[^A-Za-z0-9_]', '_', name))


def _renamed_node(node_name: str | None, library_name: str | None) -> str | None:
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


def _default_email(name: str) -> str:
    """
    Determine the maintainer's email address when none is given.

    Parameters
    ----------
    name
        The maintainer's name.

    Returns
    -------
    str
        Git's `user.email`, or else the placeholder `<name>@todo.todo`.

    """
    try:
        result = subprocess.run(
            ['git', 'config', '--get', 'user.email'], capture_output=True, text=True, check=False
        )
    except OSError:
        return f'{name}@todo.todo'
    return result.stdout.strip() or f'{name}@todo.todo'
