# SPDX-License-Identifier: Apache-2.0
"""Write a graph, and let graphviz draw it."""

from __future__ import annotations

from collections.abc import Callable
import os
import shutil
import subprocess
import time

_TIMEOUT_S = 60.0
_LOOK_S = 0.1


def write_graph(path: str, graph: str) -> str:
    """Write the graph as PATH.gv; return the path of the file, or raise OSError."""
    os.makedirs(os.path.dirname(path) or '.', exist_ok=True)
    with open(f'{path}.gv', 'w', encoding='utf-8') as file:
        file.write(graph)
    return f'{path}.gv'


def draw(path: str, is_stopped: Callable[[], bool]) -> str:
    """
    Draw PATH.gv as PATH.pdf; return what kept it from being drawn, or ''.

    :param is_stopped: is asked again and again while graphviz works
    """
    if shutil.which('dot') is None:
        return (
            f"There is no {path}.pdf, because graphviz's program 'dot' is not installed. Install "
            f"it ('sudo apt install graphviz') and run 'dot -Tpdf {path}.gv -o {path}.pdf', or "
            f'paste {path}.gv into a viewer of graphviz files'
        )
    command = ['dot', '-Tpdf', f'{path}.gv', '-o', f'{path}.pdf']
    try:
        process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
    except OSError as error:
        return f'dot cannot be started: {error.strerror}'
    return _problem(process, path, is_stopped)


def _problem(process: subprocess.Popen[str], path: str, is_stopped: Callable[[], bool]) -> str:
    """Wait until graphviz has drawn, for a while; return what went wrong, or ''."""
    end_s = time.monotonic() + _TIMEOUT_S
    while True:
        try:
            _, errors = process.communicate(timeout=_LOOK_S)
            return f'dot could not draw {path}.gv: {errors.strip()}' if process.returncode else ''
        except subprocess.TimeoutExpired:
            if is_stopped() or time.monotonic() > end_s:
                break
    process.kill()
    process.communicate()
    return f'dot has not drawn {path}.gv so far, and was stopped'
