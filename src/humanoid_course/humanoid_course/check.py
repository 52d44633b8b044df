# SPDX-License-Identifier: Apache-2.0
"""Check an exercise of the course: `ros2 run humanoid_course check exercise_1`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import os
from pathlib import Path
import signal
import sys

from ament_index_python.packages import get_packages_with_prefixes
from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened
from humanoid_course import exercise_1, exercise_2, exercise_3
from humanoid_course.grading import Exercise, grade, Results
from humanoid_course.observations import Submission
from humanoid_course.observer import free_domain
from humanoid_course.report import is_complete, listing, result_lines, summary
from humanoid_course.trial import missing_programs, scratch_folder, Trial
from humanoid_course.workspace import find_workspace

_MODULES = (exercise_1, exercise_2, exercise_3)
EXERCISES: dict[str, Exercise[Submission]] = {
    each.EXERCISE.name: each.EXERCISE for each in _MODULES
}


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    """
    Parse the command line.

    Parameters
    ----------
    arguments : Sequence[str]
        The arguments, without the name of the program.

    """
    parser = argparse.ArgumentParser(
        prog='ros2 run humanoid_course check',
        description='Check your own package against the criteria of an exercise.',
        epilog='The status is 0 only if all criteria are passed, 1 if not, 2 if the check '
        'cannot start.',
    )
    parser.add_argument('exercise', nargs='?', help='such as exercise_1; without it: list them')
    parser.add_argument('--list', action='store_true', help='list the exercises and criteria')
    parser.add_argument('--package', help='your package, if it has another name')
    parser.add_argument('--models', help='your package of robot models, which exercise_3 asks for')
    parser.add_argument('--workspace', help='the folder of your workspace')
    parser.add_argument('--launch-file', default='', help='the name of your launch file')
    return parser.parse_args(arguments)


def find_exercise(name: str) -> Exercise[Submission]:
    """
    Look an exercise up by its name.

    Parameters
    ----------
    name
        The name, or its number alone.

    Raises
    ------
    UserError
        There is no such exercise.

    """
    exercise = EXERCISES.get(name) or EXERCISES.get(f'exercise_{name}')
    if exercise is None:
        hint = did_you_mean(name, EXERCISES)
        raise UserError(
            f"There is no exercise '{shortened(name)}'. {hint} The exercises are: "
            f'{", ".join(EXERCISES)}.'.replace('  ', ' ')
        )
    return exercise


def check(exercise: Exercise[Submission], options: argparse.Namespace) -> int:
    """
    Check an exercise, and print the report line by line.

    Parameters
    ----------
    exercise
        The exercise.
    options
        The options of the command line.

    Returns
    -------
    int
        The exit status: 0 if all criteria are passed, otherwise 1.

    Raises
    ------
    UserError
        The environment is not sourced, or a package is not found.

    """
    missing = missing_programs()
    if missing or not os.environ.get('AMENT_PREFIX_PATH'):
        what = f"the command '{missing[0]}'" if missing else 'AMENT_PREFIX_PATH'
        raise UserError(
            f'ROS is not sourced in this terminal, where {what} is missing: run source '
            'install/setup.bash in your workspace, then check again.'
        )
    given = (options.package, options.models)
    names = [chosen or name for chosen, name in zip(given, exercise.packages)]
    workspace, found = find_workspace(options.workspace, names, Path.cwd(), os.environ)
    packages = [found[name] for name in names]
    print(f'{exercise.name}: {exercise.title}')
    print(f'Checking {", ".join(names)} in {workspace}\n', flush=True)
    results: Results = {}
    with scratch_folder() as scratch, free_domain():
        installed = get_packages_with_prefixes()
        trial = Trial(
            packages, found, installed, scratch, options.launch_file, exercise.launch_words
        )
        for criterion, verdict in grade(exercise, trial):
            results[criterion.name] = verdict
            print('\n'.join(result_lines(criterion, verdict)), flush=True)
    print(f'\n{summary(exercise, results)}')
    return 0 if is_complete(exercise, results) else 1


def main() -> int:
    """Run the command."""
    options = parse(sys.argv[1:])
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)
    try:
        if options.list or options.exercise is None:
            print('\n'.join(listing(EXERCISES.values())))
            return 0
        return check(find_exercise(options.exercise), options)
    except UserError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print('\nInterrupted: everything that was started has been ended.', file=sys.stderr)
        return 130


if __name__ == '__main__':
    sys.exit(main())
