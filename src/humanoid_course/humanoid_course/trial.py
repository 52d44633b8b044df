# SPDX-License-Identifier: Apache-2.0
"""Try a student's packages out: build them into a temporary folder, run and launch them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
import os
from pathlib import Path
import re
import shlex
import shutil
from tempfile import TemporaryDirectory

from humanoid_course.common_checks import is_launch_file, last_line
from humanoid_course.observations import Build, FIRST_MESSAGES, MODEL_MARK, Run, Stimulus
from humanoid_course.programs import Program, running
from humanoid_course.watching import stimulate, watch
from humanoid_course.workspace import Package, read_manifest

_BUILD_TIMEOUT_S = 300.0
_SOURCE_TIMEOUT_S = 60.0
_MOST_LAUNCH_FILES = 4
_READ_BYTES = 100_000
"""So much is read of the end of a log."""
_ROBOT = re.compile(r'(<robot\b[^>]*?\bname\s*=\s*["\'])([^"\']+)')


class Trial:
    """
    The packages of a student on trial; each observation is made once.

    Parameters
    ----------
    packages
        The packages, in the order in which the exercise names them.
    workspace
        All packages of their workspace, by name.
    installed
        The prefixes of the packages in the sourced environment, by name.
    scratch
        A temporary folder.
    launch_file
        The name of the launch file to try; '' to choose it by `launch_words`.
    launch_words
        Words that a launch file of the exercise contains.

    """

    def __init__(
        self,
        packages: Sequence[Package],
        workspace: Mapping[str, Package],
        installed: Mapping[str, str],
        scratch: Path,
        launch_file: str = '',
        launch_words: Sequence[str] = (),
    ) -> None:
        self.packages = packages
        self.known_packages = frozenset({*installed, *workspace})
        self._workspace = workspace
        self._installed = installed
        self._scratch = scratch
        self._launch_file = launch_file
        self._launch_words = launch_words
        own = [installed[each.name] for each in packages if each.name in installed]
        self._variables = without_prefixes(os.environ, own)
        self._build: Build | None = None
        self._runs: dict[str, Run] = {}
        self._stimuli: dict[str, Stimulus] = {}
        self._launch: list[Run] | None = None

    def build(self) -> Build:
        """Build the packages, and what they need of the workspace and is not installed."""
        if self._build is None:
            problem = self._colcon() or self._source()
            self._build = Build(problem=problem) if problem else self._installed_files()
            if not problem:
                _rename_models(self._share(each.name) for each in self.packages[1:])
        return self._build

    def _colcon(self) -> str:
        """Run colcon; return why it failed, if so."""
        chosen = _with_needs([each.name for each in self.packages], self._workspace)
        chosen = [
            each for each in chosen if each.name not in self._installed or each in self.packages
        ]
        command = ['colcon', '--log-base', str(self._scratch / 'log'), 'build']
        command += ['--base-paths', *(str(each.folder) for each in chosen)]
        for kind in ('build', 'install'):
            command += [f'--{kind}-base', str(self._scratch / kind)]
        variables = {
            **self._variables,
            'PYTHONDONTWRITEBYTECODE': '1',
            'COLCON_DEFAULTS_FILE': str(self._scratch / 'no_defaults.yaml'),
        }
        with running(command, variables, self._scratch) as program:
            if not program.wait(_BUILD_TIMEOUT_S):
                return f'colcon build did not end within {_BUILD_TIMEOUT_S:g} s'
            if program.status == 0:
                return ''
            return f'colcon build ended with status {program.status}; {self._reason(program)}'

    def _reason(self, program: Program) -> str:
        """Quote the error of the package whose build failed."""
        for log in sorted(self._scratch.glob('log/latest_build/*/stderr.log')):
            text = _end_of(log)
            errors = [line for line in text.splitlines() if re.search(r'\w*(Error|error):', line)]
            if errors:
                return f'{log.parent.name}: {errors[-1].strip()}'
        return last_line(program.output)

    def _source(self) -> str:
        """Read the variables of the built workspace, by a shell that sources it."""
        setup = self._scratch / 'install' / 'local_setup.bash'
        listed = self._scratch / 'variables'
        script = f'source "$0" > /dev/null && exec env -0 > {shlex.quote(str(listed))}'
        command = ['bash', '-c', script, str(setup)]
        with running(command, self._variables, self._scratch) as program:
            if not program.wait(_SOURCE_TIMEOUT_S):
                return f'{setup.name} did not end within {_SOURCE_TIMEOUT_S:g} s'
            if program.status != 0:
                return f'{setup.name} of the built workspace failed'
        text = listed.read_bytes().decode(errors='replace')
        pairs = [each.partition('=') for each in text.split('\0')]
        self._variables = {
            **{name: value for name, equals, value in pairs if equals},
            'ROS_LOG_DIR': str(self._scratch / 'ros_log'),
            'RCUTILS_COLORIZED_OUTPUT': '0',
            'RCUTILS_CONSOLE_OUTPUT_FORMAT': '[{severity}] [{name}]: {message}',
        }
        return ''

    def _prefix(self, name: str) -> Path:
        return self._scratch / 'install' / name

    def _share(self, name: str) -> Path:
        return self._prefix(name) / 'share' / name

    def _installed_files(self) -> Build:
        names = [each.name for each in self.packages]
        return Build(
            unlisted=tuple(
                name
                for name in names
                if not (
                    self._prefix(name) / 'share/ament_index/resource_index/packages' / name
                ).is_file()
            ),
            executables={
                name: tuple(_programs(self._prefix(name) / 'lib' / name)) for name in names
            },
            stray_executables=tuple(_programs(self._prefix(names[0]) / 'bin')),
            models={
                name: tuple(str(path.relative_to(self._share(name))) for path, _ in
                            _models(self._share(name)))
                for name in names
            },
        )  # fmt: skip

    def run_publisher(self, executable: str, topic: str) -> Run:
        """
        Run a node of the first package, and receive what it publishes.

        Parameters
        ----------
        executable
            The name of its executable.
        topic
            The topic on which readings are expected.

        """
        if executable not in self._runs:
            with self._start('run', executable) as (program, command):
                self._runs[executable] = watch(
                    program, command, lambda run: run.counts.get(topic, 0) >= FIRST_MESSAGES
                )
        return self._runs[executable]

    def run_listener(self, executable: str, topic: str) -> Stimulus:
        """
        Run a node of the first package, and send it readings.

        Parameters
        ----------
        executable
            The name of its executable.
        topic
            The topic to which it is expected to subscribe.

        """
        if executable not in self._stimuli:
            with self._start('run', executable) as (program, command):
                self._stimuli[executable] = stimulate(program, command, topic)
        return self._stimuli[executable]

    def launch(self, is_enough: Callable[[Run], bool]) -> Run:
        """
        Run the launch files of the first package until one is right.

        Parameters
        ----------
        is_enough
            Whether what was seen so far shows that the launch file is right.

        Returns
        -------
        Run
            That of the launch file that is right, or of the likeliest one; without any, one that
            has no command and saw nothing.

        """
        if self._launch is None:
            self._launch = []
            for name in self._launch_files():
                with self._start('launch', name) as (program, command):
                    run = watch(program, command, is_enough)
                if run.ran and is_enough(run):
                    self._launch.insert(0, run)
                    break
                self._launch.append(run)
        return self._launch[0] if self._launch else Run('')

    def _launch_files(self) -> list[str]:
        """Return the names of the launch files to try, the likeliest first."""
        if self._launch_file:
            return [self._launch_file]
        paths = [
            path
            for path in sorted(self._share(self.packages[0].name).rglob('*launch*'))
            if is_launch_file(path)
        ]
        scores = {path: self._score(path) for path in paths}
        paths.sort(key=lambda path: -scores[path])
        return [path.name for path in paths[:_MOST_LAUNCH_FILES]]

    def _score(self, path: Path) -> int:
        text = path.read_text(errors='replace')
        return sum(word in text for word in self._launch_words)

    @contextmanager
    def _start(self, verb: str, what: str) -> Iterator[tuple[Program, str]]:
        """Run `ros2 run` or `ros2 launch` for the first package."""
        command = ['ros2', verb, self.packages[0].name, what]
        with running(command, self._variables, self._scratch) as program:
            yield program, ' '.join(command)


def _end_of(log: Path) -> str:
    with log.open('rb') as stream:
        stream.seek(max(0, log.stat().st_size - _READ_BYTES))
        return stream.read(_READ_BYTES).decode(errors='replace')


def without_prefixes(variables: Mapping[str, str], prefixes: Sequence[str]) -> dict[str, str]:
    """
    Leave install folders out of search paths: an earlier build may have what the new one lacks.

    Parameters
    ----------
    variables
        Environment variables.
    prefixes : Sequence[str]
        The folders; one that several packages share stays.

    """
    alone = [each for each in prefixes if _is_of_one_package(Path(each))]
    return {
        name: os.pathsep.join(
            part
            for part in text.split(os.pathsep)
            if not any(Path(part).is_relative_to(prefix) for prefix in alone)
        )
        for name, text in variables.items()
    }


def _is_of_one_package(prefix: Path) -> bool:
    index = prefix / 'share' / 'ament_index' / 'resource_index' / 'packages'
    return len(os.listdir(index)) == 1 if index.is_dir() else False


def _programs(folder: Path) -> list[str]:
    if not folder.is_dir():
        return []
    return sorted(
        each.name for each in folder.iterdir() if each.is_file() and os.access(each, os.X_OK)
    )


def _models(folder: Path) -> Iterator[tuple[Path, str]]:
    """Yield the robot models below a folder with their texts."""
    for path in sorted(folder.rglob('*')):
        if path.is_file() and path.name.endswith(('.urdf', '.xacro')):
            text = path.read_text(errors='replace')
            if _ROBOT.search(text):
                yield path, text


def _rename_models(folders: Iterator[Path]) -> None:
    """Rename the robots in installed models, so that a node that has one got it from there."""
    for folder in folders:
        for path, text in list(_models(folder)):
            path.write_text(_ROBOT.sub(rf'\g<1>\g<2>{MODEL_MARK}', text, count=1))


def _with_needs(names: Sequence[str], workspace: Mapping[str, Package]) -> list[Package]:
    """Return packages with all packages of the workspace that they depend on."""
    chosen = [workspace[name] for name in names]
    for package in chosen:  # grows during the loop
        for name in sorted(read_manifest(package.folder).depends):
            if name in workspace and workspace[name] not in chosen:
                chosen.append(workspace[name])
    return chosen


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """Make a temporary folder, which is deleted after the block whatever is in it."""
    with TemporaryDirectory(prefix='humanoid_course_', ignore_cleanup_errors=True) as folder:
        yield Path(folder)


def missing_programs() -> list[str]:
    """List which of the programs that a trial needs are not on the path."""
    return [name for name in ('ros2', 'colcon', 'bash') if shutil.which(name) is None]
