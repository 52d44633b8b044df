# SPDX-License-Identifier: Apache-2.0
"""Criteria that every exercise has: manifest, dependencies, build, and an end by Ctrl-C."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
import re

from humanoid_common.naming import did_you_mean
from humanoid_course.grading import Criterion, failed, passed, unchecked, Verdict
from humanoid_course.observations import INTERRUPT_TIMEOUT_S, Run, Submission
from humanoid_course.report import quoted
from humanoid_course.workspace import MANIFEST, Package, read_manifest

Check = Criterion[Submission]
_REQUIRED = ('name', 'version', 'description', 'maintainer', 'license')
_BUILD_TYPES = ('ament_python', 'ament_cmake', 'ament_cmake_python')
_UNCAUGHT = ('KeyboardInterrupt', 'ExternalShutdownException')
_UNCAUGHT_AT_THE_END = re.compile(
    rf'^(?:\[[^\]]*\] )?(?:[\w.]+\.)?({"|".join(_UNCAUGHT)})\b', re.MULTILINE
)


def check_manifests(submission: Submission) -> Verdict:
    """
    Check that each package.xml can be read and has what ROS requires.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    for package in submission.packages:
        manifest = read_manifest(package.folder)
        where = f'{MANIFEST} of {package.name}'
        if manifest.problem:
            return failed(
                f'{where} cannot be read: {manifest.problem}',
                'well-formed XML',
                'Correct the file at that line: each <tag> needs its </tag>.',
            )
        missing = [tag for tag in _REQUIRED if not manifest.values.get(tag)]
        if 'maintainer' not in missing and not manifest.email:
            missing.append('maintainer with the attribute email')
        if missing:
            return failed(
                f'{where} lacks {quoted(missing)}',
                f'the elements {quoted(_REQUIRED)}',
                f'Add <{missing[0].split()[0]}> to {package.folder / MANIFEST}.',
            )
        version = manifest.values['version']
        if not re.fullmatch(r'\d+\.\d+\.\d+', version):
            return failed(
                f"the version in {where} is '{version}'",
                'three numbers, as in 0.1.0',
                f'Correct <version> in {package.folder / MANIFEST}.',
            )
        build_type = manifest.values.get('build_type', '')
        if build_type not in _BUILD_TYPES:
            return failed(
                f"the build type in {where} is '{build_type}'",
                'ament_python',
                'Put <export><build_type>ament_python</build_type></export> into it.',
            )
    return passed(quoted([f'{each.name}/{MANIFEST}' for each in submission.packages]))


def check_dependencies(submission: Submission) -> Verdict:
    """
    Check that each package.xml declares the ROS packages that the Python modules import.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    used: list[str] = []
    for package in submission.packages:
        declared = read_manifest(package.folder).depends
        broken, imported = _imports(package)
        if broken:
            return unchecked(
                f'Python cannot read {broken[0]}', 'Correct the syntax there, then check again.'
            )
        for name in sorted(imported):
            if name == package.name or name not in submission.known_packages:
                continue
            if name not in declared:
                return failed(
                    f'{imported[name]} imports {name}, which {MANIFEST} does not name',
                    f'<depend>{name}</depend> in {package.folder / MANIFEST}',
                    'Add that line below <license>.',
                )
            used.append(name)
    return passed(f'imported and declared: {quoted(sorted(set(used)))}')


def _imports(package: Package) -> tuple[list[str], dict[str, str]]:
    """
    Collect what the modules of a package import; launch files, set-up and tests are left out.

    Returns
    -------
    list of str, dict of str to str
        Files that cannot be parsed, with the reason; the file for each imported top-level module.

    """
    broken: list[str] = []
    found: dict[str, str] = {}
    for path in sorted(package.folder.rglob('*.py')):
        inside = path.relative_to(package.folder)
        if inside.parts[0] in ('launch', 'test', 'setup.py', 'build', 'install', 'log'):
            continue
        try:
            tree = ast.parse(path.read_bytes())
        except (SyntaxError, ValueError, RecursionError) as error:
            line = getattr(error, 'lineno', None)
            broken.append(f'{inside}{f", line {line}" if line else ""}: {error}')
            continue
        for name in _top_level_names(tree):
            found.setdefault(name, str(inside))
    return broken, found


def _top_level_names(tree: ast.AST) -> Iterator[str]:
    """Yield the top-level modules that a module imports by absolute name."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition('.')[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.partition('.')[0]


def check_build(submission: Submission) -> Verdict:
    """
    Check that colcon builds the packages, and that ROS finds what it installed.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    build = submission.build()
    names = ' '.join(each.name for each in submission.packages)
    if build.problem:
        return failed(
            build.problem,
            'a build without errors',
            f'Run colcon build --packages-select {names}, and correct the first error.',
        )
    if build.unlisted:
        name = build.unlisted[0]
        return failed(
            f'{name} was built, but `ros2 pkg list` does not list it: its marker is not installed',
            f'share/ament_index/resource_index/packages/{name} among the installed files',
            f"Keep the line ('share/ament_index/resource_index/packages', ['resource/{name}']) in "
            'data_files of setup.py, and the empty file that it names.',
        )
    return passed(f'built: {names}')


def check_executables(submission: Submission, wanted: tuple[str, ...]) -> Verdict:
    """
    Check that `ros2 run` finds the executables of the first package.

    Parameters
    ----------
    submission
        The packages of the student.
    wanted
        The names of the executables.

    """
    build, package = submission.build(), submission.packages[0].name
    installed = build.executables.get(package, ())
    missing = [name for name in wanted if name not in installed]
    if not missing:
        return passed(f'ros2 run {package} {" | ".join(wanted)}')
    name = missing[0]
    if name in build.stray_executables:
        return failed(
            f'{name} was installed into bin, where `ros2 run` does not look',
            f'lib/{package}/{name}',
            f'Put script_dir=$base/lib/{package} below [develop] and '
            f'install_scripts=$base/lib/{package} below [install] in setup.cfg.',
        )
    hint = did_you_mean(name, installed)
    return failed(
        f'no executable {name}; installed are: {quoted(installed)}. {hint}'.strip(),
        f'executables {quoted(wanted)}',
        f"Add '{name} = {package}.{name}:main' to console_scripts in setup.py; the part "
        'before = is the name of the executable.',
    )


def check_end(run: Run, what: str) -> Verdict:
    """
    Check that Ctrl-C ended a program in time, with everything that it started.

    Parameters
    ----------
    run
        What the program did.
    what
        The program, as the subject of a sentence.

    """
    if run.left:
        return failed(
            f'{INTERRUPT_TIMEOUT_S:g} s after Ctrl-C, {quoted(run.left, 3)} was still running '
            'and had to be killed',
            f'that {what} ends within {INTERRUPT_TIMEOUT_S:g} s',
            'Do not block in callbacks, do not ignore SIGINT, and let main() end when '
            'rclpy.spin() does.',
        )
    return passed(f'{what} ended')


def check_interrupt(run: Run, executable: str) -> Verdict:
    """
    Check that a node ends by Ctrl-C, and that its main() expects that.

    Other exceptions can come from the interruption of rclpy itself, and are not the student's.

    Parameters
    ----------
    run
        What the node did.
    executable
        Its name.

    """
    uncaught = _UNCAUGHT_AT_THE_END.findall(run.last_words)
    if uncaught and 'Traceback' in run.last_words:
        return failed(
            f'{executable} ended with a traceback: {uncaught[-1]}',
            'an end without a traceback',
            'Put rclpy.spin(node) into try, and add: except (KeyboardInterrupt, '
            'rclpy.executors.ExternalShutdownException): pass.',
        )
    return check_end(run, executable)


def check_ran(run: Run, executable: str) -> Verdict | None:
    """
    Make the verdict on a node that ended by itself; None if it ran until Ctrl-C.

    Parameters
    ----------
    run
        What the node did.
    executable
        Its name.

    """
    if run.ran:
        return None
    return failed(
        f'{executable} ended by itself with status {run.status}; {last_line(run.output)}',
        'a node that runs until Ctrl-C',
        f'Run it in a terminal ({run.command}) and correct the error that it reports; main() has '
        'to call rclpy.spin(node).',
    )


def last_line(output: str) -> str:
    """
    Quote the last line of a program's output, or say that there is none.

    Parameters
    ----------
    output
        The output.

    """
    lines = [
        line for line in output.splitlines() if line.strip() and not line.startswith('[ros2run]')
    ]
    return f'its last line: {lines[-1].strip()}' if lines else 'it wrote nothing'


def missing_launch_file(submission: Submission, words: str) -> Verdict:
    """
    Make the verdict on a package without an installed launch file.

    Parameters
    ----------
    submission
        The packages of the student.
    words
        What the launch file is to start.

    """
    package = submission.packages[0]
    there = [
        str(path.relative_to(package.folder))
        for path in sorted(package.folder.rglob('*launch*'))
        if is_launch_file(path)
    ]
    if there:
        return failed(
            f'{there[0]} is in the source folder, but not installed',
            'a launch file among the installed files',
            f"Add ('share/{package.name}/launch', glob('launch/*')) to data_files in setup.py, "
            'with `from glob import glob` at its beginning.',
        )
    return failed(
        'no launch file',
        f'a launch file that starts {words}',
        f'Create {package.folder}/launch/{package.name}.launch.py, and install it in setup.py.',
    )


def is_launch_file(path: Path) -> bool:
    """
    Whether a file is a launch file by its name.

    Parameters
    ----------
    path
        The file.

    """
    return bool(re.search(r'[._]?launch\.(py|xml|ya?ml)$', path.name)) and path.is_file()


MANIFESTS = Check('manifest', 'package.xml can be read and is complete', check_manifests)
DEPENDENCIES = Check(
    'dependencies',
    'package.xml declares the ROS packages that the nodes import',
    check_dependencies,
    ('manifest',),
)
BUILD = Check('build', 'the package builds without errors', check_build, ('manifest',))
