# SPDX-License-Identifier: Apache-2.0
"""Write a graph, and draw it: by graphviz as a PDF, without it as an SVG."""

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
    Write the graph of the frames as PATH.gv, and create its folder.

    Parameters
    ----------
    path
        The path without extension.
    graph
        The graph in the language of Graphviz.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    OSError
        It cannot be written.

    """
    os.makedirs(os.path.dirname(path) or '.', exist_ok=True)
    with open(f'{path}.gv', 'w', encoding='utf-8') as file:
        file.write(graph)
    return f'{path}.gv'


def has_graphviz() -> bool:
    """Whether graphviz's program `dot` is installed."""
    return shutil.which('dot') is not None


def write_tree(path: str, frames: Frames) -> str:
    """
    Draw the tree of the frames as PATH.svg.

    Parameters
    ----------
    path
        The path without extension.
    frames
        What `Buffer.all_frames_as_yaml` says of each frame that has a parent.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    OSError
        It cannot be written.

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
        Polled every 0.1 s while Graphviz works, which is killed when it returns True, or after 60
        s.

    Returns
    -------
    str
        Why the file was not rendered; '' if it was.

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
