# SPDX-License-Identifier: Apache-2.0
"""Check the model of the humanoid, or a URDF: `ros2 run humanoid_description check_model`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import os
from pathlib import Path
import signal
import sys

from humanoid_description.errors import DescriptionError


def main(argv: Sequence[str] | None = None) -> int:
    """
    Check a robot model, and print a table of the checks and the defects.

    Parameters
    ----------
    argv
        The command line without the program's name; None for that of the process.

    Returns
    -------
    int
        The exit status: 0 without defects; 1 with some, or if no model can be read or no result
        written; 128 plus the signal's number after SIGINT or SIGPIPE.

    """
    arguments = _parser().parse_args(argv)
    try:
        text, source = _urdf(arguments)
        return _check(text, source, (arguments.file or Path()).parent)
    except DescriptionError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT


def _parser() -> argparse.ArgumentParser:
    """Build the argument parser."""
    parser = argparse.ArgumentParser(
        prog='check_model',
        description='Check a robot model: its tree, bodies and joints; for the humanoid, also its '
        'names, symmetry, size, weight, stance and reach.',
    )
    parser.add_argument(
        'file', nargs='?', type=Path, help='a URDF or xacro file (default: the humanoid)'
    )
    parser.add_argument(
        'arguments', nargs='*', metavar='NAME:=VALUE', help='arguments of the xacro file'
    )
    humanoid = parser.add_argument_group('options of the humanoid, without a file')
    humanoid.add_argument('--scale', type=float, help='size, 0.5 to 1.3 (default: 1.0)')
    humanoid.add_argument('--prefix', help='prefix of all link and joint names')
    humanoid.add_argument('--upper-body-only', action='store_true', help='leave out the legs')
    humanoid.add_argument('--hands', action='store_true', help='add wrists and grippers')
    return parser


def _urdf(arguments: argparse.Namespace) -> tuple[str, str]:
    """Return the URDF to check, and its name for the report."""
    path: Path | None = arguments.file
    if path is None:
        return _humanoid(arguments)
    has_options = arguments.scale is not None or arguments.prefix is not None
    if has_options or arguments.upper_body_only or arguments.hands:
        raise DescriptionError(
            f'{path} is checked as it is. Leave out --scale, --prefix, --upper-body-only and '
            '--hands, which apply to the built-in humanoid, or leave out the file.'
        )
    try:
        return _file(path, arguments.arguments)
    except OSError as error:
        raise DescriptionError(f'{path} cannot be read: {error.strerror}.') from error
    except UnicodeDecodeError as error:
        raise DescriptionError(f'{path} is not valid UTF-8 text.') from error


def _file(path: Path, words: Sequence[str]) -> tuple[str, str]:
    """Return the URDF of a URDF or xacro file, and its name for the report."""
    given = _given(path, words)
    text = path.read_text(encoding='utf-8')
    if path.suffix != '.xacro':
        return text, str(path)
    from humanoid_description.expansion import expand

    return expand(path, given), f'The xacro output of {path}'


def _given(path: Path, words: Sequence[str]) -> dict[str, str]:
    """Parse the arguments of a xacro file, by their names."""
    if ':=' in str(path):
        raise DescriptionError(
            f"'{path}' is an argument of a xacro file: name the file before it. The humanoid has "
            'the options --scale, --prefix, --upper-body-only and --hands.'
        )
    for word in words:
        if ':=' not in word[1:]:
            raise DescriptionError(
                f"'{word}' is not a xacro argument of the form NAME:=VALUE. Give only one file."
            )
    if words and path.suffix != '.xacro':
        raise DescriptionError(f"{path} is not a xacro file; it cannot take '{words[0]}'.")
    return {name: value for name, _, value in (word.partition(':=') for word in words)}


def _humanoid(arguments: argparse.Namespace) -> tuple[str, str]:
    """Return the URDF of the humanoid with the given options, and its name for the report."""
    from humanoid_description.drives import load_scaling
    from humanoid_description.expansion import humanoid_urdf

    scale = 1.0 if arguments.scale is None else arguments.scale
    load_scaling().check(scale)
    urdf = humanoid_urdf(scale, arguments.prefix or '', arguments.upper_body_only, arguments.hands)
    which = 'The upper body of the humanoid' if arguments.upper_body_only else 'The humanoid'
    hands = ' with hands' if arguments.hands else ''
    prefix = f" with the prefix '{arguments.prefix}'" if arguments.prefix else ''
    return urdf, f'{which}{hands}{prefix} at scale {scale:g}'


def _check(text: str, source: str, folder: Path) -> int:
    """Check a URDF, print the report, and return the exit status."""
    from humanoid_description.checks import check_robot
    from humanoid_description.checks.outcome import report
    from humanoid_description.loading import load_robot

    outcomes = check_robot(load_robot(text, source, folder))
    shown = _show(report(source, outcomes))
    return shown or int(any(outcome.defects for outcome in outcomes))


def _show(text: str) -> int:
    """Print a text; return a non-zero exit status if it cannot be written."""
    try:
        print(text, flush=True)
    except OSError as error:
        # Otherwise the interpreter would flush again at exit, and print an error.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):
            return 128 + signal.SIGPIPE
        print(f'The result cannot be written: {error.strerror}.', file=sys.stderr)
        return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
