# SPDX-License-Identifier: Apache-2.0
"""Write the frame graph and render it as a PDF with Graphviz, or else as an SVG."""

from __future__ import annotations

from collections.abc import Callable
import os
import shutil
import subprocess
import time

from tf2_tools.tree_svg import Frames, tree_svg

_TIMEOUT_S = 60.0
_LOOK_S = 0.1


def write_graph(path: str, graph: str) -> str:
    """
    Write the frame graph as PATH.gv; create its directory if needed.

    Parameters
    ----------
    path
        The path without extension.
    graph
        The graph in the DOT language of Graphviz.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    OSError
        The file cannot be written.

    """
    os.makedirs(os.path.dirname(path) or '.', exist_ok=True)
    with open(f'{path}.gv', 'w', encoding='utf-8') as file:
        file.write(graph)
    return f'{path}.gv'


def has_graphviz() -> bool:
    """Whether the program `dot` of Graphviz is installed."""
    return shutil.which('dot') is not None


def write_tree(path: str, frames: Frames) -> str:
    """
    Draw the frame tree as PATH.svg.

    Parameters
    ----------
    path
        The path without extension.
    frames
        The parsed output of `Buffer.all_frames_as_yaml`: the entry of each frame with a parent.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    OSError
        The file cannot be written.

    """
    with open(f'{path}.svg', 'w', encoding='utf-8') as file:
        file.write(tree_svg(frames))
    return f'{path}.svg'


def draw(path: str, is_stopped: Callable[[], bool]) -> str:
    """
    Render PATH.gv as PATH.pdf with Graphviz.

    Parameters
    ----------
    path
        The path without extension.
    is_stopped
        Polled every 0.1 s while Graphviz runs; Graphviz is killed when this returns True, or
        after 60 s.

    Returns
    -------
    str
        The reason why the file was not rendered; '' on success.

    """
    command = ['dot', '-Tpdf', f'{path}.gv', '-o', f'{path}.pdf']
    try:
        process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
    except OSError as error:
        return f'dot cannot be started: {error.strerror}'
    return _problem(process, path, is_stopped)


def _problem(process: subprocess.Popen[str], path: str, is_stopped: Callable[[], bool]) -> str:
    """Wait for Graphviz with a timeout; return the error message, or '' on success."""
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
