# SPDX-License-Identifier: Apache-2.0
"""The command `launch_test`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from importlib.util import module_from_spec, spec_from_file_location
import os
import sys
from types import ModuleType
from typing import Optional

from launch_testing.loader import LoadTestsFromPythonModule, TestRun
from launch_testing.test_runner import LaunchTestRunner

__all__ = ['main']


def main(argv: Optional[Sequence[str]] = None) -> int:
    """
    Run a launch test file from the command line.

    Parameters
    ----------
    argv
        The arguments without the program name; None for those of the process.

    Returns
    -------
    int
        The exit code: 0 on success, 1 on failure, 130 after an interrupt.

    Raises
    ------
    SystemExit
        The arguments are invalid, or the file does not exist.

    """
    parser = _parser()
    options = parser.parse_args(argv)
    if not os.path.isfile(options.test_file):
        parser.error(f"the launch test '{options.test_file}' does not exist")
    try:
        return _run(options)
    except KeyboardInterrupt:
        print('launch_test: interrupted', file=sys.stderr)
        return 130
    except (AttributeError, RuntimeError, TypeError) as error:
        print(f'launch_test: {error}', file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='launch_test',
        description='Launches what a launch test describes, and runs its tests.',
    )
    parser.add_argument('test_file', help='the path of the launch test')
    parser.add_argument(
        'launch_arguments',
        nargs='*',
        help="arguments of the launch description: '<name>:=<value>'",
    )
    parser.add_argument('-v', '--verbose', action='store_true', help='tell more')
    parser.add_argument(
        '-s',
        '--show-args',
        '--show-arguments',
        action='store_true',
        help='show the arguments of the launch description and exit',
    )
    parser.add_argument('--package-name', help='the name of the package in the report')
    parser.add_argument('--junit-xml', metavar='FILE', help='write the results to this file')
    return parser


def _run(options: argparse.Namespace) -> int:
    from ros2launch.api.arguments import parse_launch_arguments

    parse_launch_arguments(options.launch_arguments)
    name = os.path.splitext(os.path.basename(options.test_file))[0]
    runs = LoadTestsFromPythonModule(_load(options.test_file, name), name=name)
    if options.show_args:
        return _show_arguments(runs)
    runner = LaunchTestRunner(
        runs,
        options.launch_arguments,
        debug=options.verbose,
        verbosity=2 if options.verbose else 1,
    )
    results = runner.run()
    if options.junit_xml:
        from launch_testing.junitxml import unittestResultsToXml

        unittestResultsToXml(
            name='.'.join(filter(None, (options.package_name, name))),
            test_results={str(run): result for run, result in results.items()},
        ).write(options.junit_xml, encoding='utf-8', xml_declaration=True)
    return 0 if all(result.wasSuccessful() for result in results.values()) else 1


def _load(path: str, name: str) -> ModuleType:
    """Import a file as a module."""
    spec = spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise RuntimeError(f"the launch test '{path}' is not a Python file")
    module = module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def _show_arguments(runs: list[TestRun]) -> int:
    from ros2launch.api.running import argument_lines, HEADER

    description = runs[0].get_launch_description()
    print('\n'.join([HEADER, *argument_lines(description.get_launch_arguments())]))
    return 0


if __name__ == '__main__':
    sys.exit(main())
