# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 pkg create`."""

from __future__ import annotations

import argparse
import getpass
import os

from ros2pkg.create import create_package, PackageDescription
from ros2pkg.create.checks import refusal, renamed_node
from ros2pkg.create.licenses import known_licenses, unknown_license_warning
from ros2pkg.create.maintainer import default_email
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
        problem = refusal(args, folder)
        if problem:
            return problem
        args.node_name = renamed_node(args.node_name, args.library_name)
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
        maintainer_email=args.maintainer_email or default_email(args.maintainer_name),
        dependencies=tuple(args.dependencies),
        node_name=args.node_name,
        library_name=args.library_name,
    )
