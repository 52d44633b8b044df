# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C on nodes that end with rclpy.shutdown(), as those of books and tutorials do."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import signal
import subprocess
import sys
from typing import Any

import pytest

Start = Callable[..., Any]

NODE = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64


class Sweep(Node):
    def __init__(self):
        super().__init__('sweep')
        self.angle = self.create_publisher(Float64, 'angle', 10)
        self.timer = self.create_timer(0.02, self.step)
        self.steps = 0

    def step(self):
        self.angle.publish(Float64(data=0.5))
        self.steps += 1
        if self.steps == 3:  # it spins: an interrupt before that is another story
            self.get_logger().info('sweeping')


def main(args=None):
    rclpy.init(args=args)
    node = Sweep()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.shutdown()


if __name__ == '__main__':
    main()
"""
LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='arm', executable='sweep', name=f'sweep_{{number}}', output='screen')
        for number in range({nodes})])
"""
SIGNALED = """
import os, signal, time
import rclpy

rclpy.init()
try:
    os.kill(os.getpid(), signal.SIGINT)
    while True:  # a thread that is just starting may take the signal: no sleep is cut short then
        time.sleep(0.01)
except KeyboardInterrupt:
    pass
while rclpy.ok():
    time.sleep(0.01)
"""


WOKEN = """
import threading
import rclpy
import rclpy.executors

rclpy.init()
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(rclpy.create_node('waits'))
woken, has_looked = threading.Event(), threading.Event()


def signal():
    # What rclpy's thread of signals does, with a look at the context in between.
    woken.set()
    executor._sigint_gc.trigger()
    has_looked.wait()
    executor.context.handle.shutdown()


def look():
    is_ok = ok()
    if woken.is_set():
        has_looked.set()
    return is_ok


ok, executor.context.ok = executor.context.ok, look
threading.Timer(0.5, signal).start()
try:
    executor.spin()
except rclpy.executors.ExternalShutdownException:
    print('done')
"""
SHUT_DOWN_BETWEEN = """
import rclpy
import rclpy.executors

rclpy.init()
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(rclpy.create_node('waits'))
context = executor.context
ok = context.ok


def look():
    is_ok = ok()
    if is_ok:
        context.handle.shutdown()
    return is_ok


context.ok = look
try:
    executor.spin()
except rclpy.executors.ExternalShutdownException:
    print('done')
"""


@pytest.fixture
def prefix(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, own_domain: int) -> Path:
    """Return the prefix of a package with a node, which is the first that is searched."""
    found = tmp_path / 'prefix'
    index = found / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    (index / 'arm').touch()
    program = found / 'lib' / 'arm' / 'sweep'
    program.parent.mkdir(parents=True)
    program.write_text(NODE)
    program.chmod(0o755)
    known = os.environ.get('AMENT_PREFIX_PATH', '')
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{found}{os.pathsep}{known}')
    monkeypatch.setenv('ROS_LOG_DIR', str(tmp_path / 'log'))
    return found


def interrupted(program: Any) -> int:
    """Interrupt a program and all that is in its group, as a terminal does; return its status."""
    os.killpg(program.process.pid, signal.SIGINT)
    return int(program.process.wait(60))


@pytest.mark.parametrize('nodes', [2, 4])
def test_launch(prefix: Path, start: Start, nodes: int) -> None:
    """Each node ends cleanly, be it executed or, as one of many, forked."""
    path = prefix / 'sweep.launch.py'
    path.write_text(LAUNCH.format(nodes=nodes))
    program = start('ros2', 'launch', str(path))
    for number in range(nodes):
        program.wait_for(f'[sweep_{number}]: sweeping')
    assert interrupted(program) == 0
    assert 'Traceback' not in program.output and 'has died' not in program.output
    assert program.output.count('process has finished cleanly') == nodes


def test_run(prefix: Path, start: Start) -> None:
    """The node alone ends as quietly, when ros2 run passes on what only it was sent."""
    program = start('ros2', 'run', 'arm', 'sweep')
    program.wait_for('sweeping')
    program.process.send_signal(signal.SIGINT)
    program.process.wait(60)
    assert 'Error' not in program.output and 'Traceback' not in program.output


def outcome(script: str) -> str:
    """Return the last line that a script of rclpy writes: of a traceback if it fails or hangs."""
    watched = f'import faulthandler; faulthandler.dump_traceback_later(50.0, exit=True)\n{script}'
    done = subprocess.run(
        [sys.executable, '-c', watched],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
        check=False,
    )
    return done.stdout.strip().splitlines()[-1] if done.stdout.strip() else ''


@pytest.mark.parametrize(
    ('calls', 'last'),
    [
        ('rclpy.shutdown()', 'done'),
        ('rclpy.try_shutdown()', 'done'),
        ('rclpy.shutdown(); rclpy.init(); rclpy.shutdown()', 'done'),
        ('rclpy.shutdown(); rclpy.shutdown()', 'RuntimeError'),
    ],
)
def test_shutdown_after_a_signal(own_domain: int, calls: str, last: str) -> None:
    """What a signal has shut down may be shut down by one call, and ROS can be used anew."""
    assert last in outcome(f"{SIGNALED}\n{calls}; print('done')")


@pytest.mark.parametrize(
    ('calls', 'error'),
    [
        ('context.shutdown(); context.shutdown()', 'rcl_shutdown already called'),
        ('context.try_shutdown(); context.shutdown()', 'rcl_shutdown already called'),
        ('context.try_shutdown(); context.try_shutdown(); print("done")', 'done'),
        ('rclpy.shutdown()', 'Context must be initialized'),
    ],
)
def test_shutdown_without_a_signal(own_domain: int, calls: str, error: str) -> None:
    """A second call is the error that it is elsewhere."""
    script = 'import rclpy; from rclpy.context import Context; context = Context()'
    assert error in outcome(f'{script}\ncontext.init()\n{calls}')


@pytest.mark.parametrize('script', [WOKEN, SHUT_DOWN_BETWEEN], ids=['woken before', 'not woken'])
def test_shutdown_just_after_a_look_at_the_context(own_domain: int, script: str) -> None:
    """The executor ends as if it had been shut down before: it neither hangs nor fails."""
    assert outcome(script) == 'done'
