# SPDX-License-Identifier: Apache-2.0
"""Test in a separate process whether rclpy starts, since it may crash or exit."""

from __future__ import annotations

from functools import lru_cache
import re
import subprocess
import sys

PROBE = 'import rclpy; rclpy.init(); rclpy.create_node("_ros2cli_probe"); rclpy.shutdown()'
TIMEOUT_S = 30.0
ERROR_LINE = re.compile(r'[A-Za-z_.]*Error: ')


@lru_cache(maxsize=1)
def why_rclpy_does_not_start() -> str:
    """Return the last error of a process that uses rclpy, or '' if it succeeds."""
    try:
        result = subprocess.run(
            [sys.executable, '-c', PROBE],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=TIMEOUT_S,
        )
    except subprocess.TimeoutExpired:
        return f'it has not started within {TIMEOUT_S:g} s'
    if result.returncode == 0:
        return ''
    lines = result.stderr.decode(errors='replace').split('\n')
    said = [line.strip() for line in lines if line.strip()]
    errors = [line for line in said if ERROR_LINE.match(line)]
    return (errors or said or [f'its process ended with status {result.returncode}'])[-1]
