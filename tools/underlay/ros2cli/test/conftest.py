# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a domain of one's own, a talker, and the command line as a process."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import ctypes
from functools import partial
import os
from pathlib import Path
import signal
import subprocess
import sys
from typing import Any

from domain_coordinator import domain_id
import pytest
from ros2cli.cli import main

ROOT = Path(__file__).parents[1]
# For what several test modules share.
sys.path.insert(0, str(Path(__file__).parent))
TIMEOUT_S = 100.0
PR_SET_PDEATHSIG = 1


@pytest.fixture(scope='session')
def ros_environment_variables() -> Iterator[dict[str, str]]:
    """Reserve a domain and return the environment for processes in it."""
    with domain_id() as domain:
        path = os.pathsep.join([str(ROOT), os.environ.get('PYTHONPATH', '')]).rstrip(os.pathsep)
        yield {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'PYTHONPATH': path,
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
            'PYTHONUNBUFFERED': '1',
        }


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Reserve a domain for this process and its children."""
    with domain_id() as domain:
        monkeypatch.setenv('ROS_DOMAIN_ID', str(domain))
        monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        yield domain


@pytest.fixture(scope='session')
def talker(ros_environment_variables: dict[str, str]) -> Iterator[None]:
    """Run the talker for all tests that look at the graph."""
    with helper_process('talker.py', ros_environment_variables):
        yield


@pytest.fixture(scope='session')
def robot(ros_environment_variables: dict[str, str]) -> Iterator[dict[str, str]]:
    """Run the robot in a domain of its own; return the variables of that domain."""
    with domain_id() as domain:
        variables = {'ROS_DOMAIN_ID': str(domain)}
        with helper_process('robot.py', {**ros_environment_variables, **variables}):
            yield variables


@pytest.fixture(scope='session')
def container(ros_environment_variables: dict[str, str]) -> Iterator[dict[str, str]]:
    """Run a container of components in a domain of its own; return its variables."""
    pytest.importorskip('composition_interfaces.srv')
    with domain_id() as domain:
        variables = {'ROS_DOMAIN_ID': str(domain)}
        with helper_process('container.py', {**ros_environment_variables, **variables}):
            yield variables


def _end_with_the_tests() -> None:
    """Ask the kernel to kill this process when the process of the tests is no more."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


@contextmanager
def helper_process(name: str, environment: dict[str, str]) -> Iterator[None]:
    """Run a program of this folder from when it is ready to the end of the block."""
    process = subprocess.Popen(
        [sys.executable, str(Path(__file__).with_name(name))],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=_end_with_the_tests,
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == 'ready\n'
        yield
    finally:
        process.kill()
        process.communicate()


@pytest.fixture
def start_ros2(
    ros_environment_variables: dict[str, str],
) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Return a function that starts a command; what still runs is ended after the test."""
    started: list[subprocess.Popen[str]] = []

    def start(*words: str, **options: Any) -> subprocess.Popen[str]:
        environment = {**ros_environment_variables, **options.pop('extra', {})}
        process = subprocess.Popen(
            [sys.executable, '-m', 'ros2cli', *words],
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            **options,
        )
        started.append(process)
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.fixture
def ros2(start_ros2: Callable[..., Any]) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Return a function that runs a command to its end."""

    def run(*words: str, **options: Any) -> subprocess.CompletedProcess[str]:
        process = start_ros2(*words, **options)
        output, errors = process.communicate(timeout=TIMEOUT_S)
        return subprocess.CompletedProcess(words, process.returncode, output, errors)

    return run


@pytest.fixture
def ros2_here(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    ros_environment_variables: dict[str, str],
) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Return a function that runs a command in this process, which saves its start-up."""

    def run(*words: str, **extra: str) -> subprocess.CompletedProcess[str]:
        for name in ('ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE'):
            monkeypatch.setenv(name, extra.get(name, ros_environment_variables[name]))
        status = main(words)
        captured = capsys.readouterr()
        return subprocess.CompletedProcess(words, status, captured.out, captured.err)

    return run


@pytest.fixture
def ros2_robot(
    ros2_here: Callable[..., subprocess.CompletedProcess[str]], robot: dict[str, str]
) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Return a function that runs a command in this process, where it sees the robot."""
    return partial(ros2_here, **robot)


@pytest.fixture
def start_at_robot(
    start_ros2: Callable[..., subprocess.Popen[str]], robot: dict[str, str]
) -> Callable[..., subprocess.Popen[str]]:
    """Return a function that starts a command which sees the robot."""
    return partial(start_ros2, extra=robot)
