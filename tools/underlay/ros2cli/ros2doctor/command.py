# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 doctor`, and `ros2 wtf`, which is the same."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence

from ros2cli.command import CHOSEN_VERB, VerbCommand
from ros2cli.entry import Entry


class DoctorCommand(VerbCommand):
    """Check ROS setup and other potential issues."""

    VERB_GROUP = 'ros2doctor.verb'
    VERBS = {
        'hello': Entry(
            'ros2doctor.verb.hello:HelloVerb', 'Check network connectivity between multiple hosts'
        ),
    }

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the choice of checks and reports, then the verbs.

        Parameters
        ----------
        parser
            The parser of the command.
        cli_name
            The command line up to the command, such as `ros2 doctor`, for the help of its verbs.
        argv
            The words after these, which tell which verb is called; its arguments are added, too.

        """
        add_either = parser.add_mutually_exclusive_group().add_argument
        add_either('-r', '--report', action='store_true', help='Print all reports')
        add_either(
            '-rf',
            '--report-failed',
            action='store_true',
            help='Check, and print the reports of what failed',
        )
        parser.add_argument(
            '-ep',
            '--exclude-packages',
            action='store_true',
            help='Leave out the packages of the workspace',
        )
        parser.add_argument(
            '-iw', '--include-warnings', action='store_true', help='Count warnings as failures'
        )
        super().add_arguments(parser, cli_name, argv=argv)

    def extension_points(self) -> Mapping[str, Mapping[str, Entry]]:
        """Return the groups of the verbs, checks and reports."""
        from ros2doctor.api.examining import CHECK_GROUP, CHECKS, REPORT_GROUP, REPORTS

        return {**super().extension_points(), CHECK_GROUP: CHECKS, REPORT_GROUP: REPORTS}

    def main(
        self, *, parser: argparse.ArgumentParser, args: argparse.Namespace
    ) -> int | str | None:
        """
        Call the verb if one was given; else print the reports, or run the checks.

        Parameters
        ----------
        parser
            The parser of the command.
        args : argparse.Namespace
            What it has parsed.

        Returns
        -------
        int or str or None
            What the verb returns; without one 0, or 1 if a check failed.

        """
        if hasattr(args, CHOSEN_VERB):
            return super().main(parser=parser, args=args)
        from ros2doctor.api.examining import examine, print_reports

        if args.report:
            print_reports(exclude_packages=args.exclude_packages)
            return 0
        failed = examine(
            include_warnings=args.include_warnings, exclude_packages=args.exclude_packages
        )
        if args.report_failed and failed:
            print_reports(categories=failed, exclude_packages=args.exclude_packages)
        return 1 if failed else 0


class WtfCommand(DoctorCommand):
    """Use `wtf` as alias to `doctor`."""
