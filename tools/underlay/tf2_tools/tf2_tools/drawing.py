# SPDX-License-Identifier: Apache-2.0
"""Write a graph, and let graphviz draw it."""

from __future__ import annotations

import os
import shutil
import subprocess

_TIMEOUT_S = 60.0


def write_graph(path: str, graph: str) -> str:
    """Write the graph as PATH.gv; return the path of the file, or raise OSError."""
    os.makedirs(os.path.dirname(path) or '.', exist_ok=True)
    with open(f'{path}.gv', 'w', encoding='utf-8') as file:
        file.write(graph)
    return f'{path}.gv'


def draw(path: str) -> str:
    """Draw PATH.gv as PATH.pdf; return what kept it from being drawn, or ''."""
    if shutil.which('dot') is None:
        return (
            f"There is no {path}.pdf, because graphviz's program 'dot' is not installed. Install "
            f"it ('sudo apt install graphviz') and run 'dot -Tpdf {path}.gv -o {path}.pdf', or "
            f'paste {path}.gv into a viewer of graphviz files'
        )
    command = ['dot', '-Tpdf', f'{path}.gv', '-o', f'{path}.pdf']
    try:
        subprocess.run(command, check=True, capture_output=True, text=True, timeout=_TIMEOUT_S)
    except subprocess.CalledProcessError as error:
        return f'dot could not draw {path}.gv: {error.stderr.strip()}'
    except subprocess.TimeoutExpired:
        return f'dot has not drawn {path}.gv within {_TIMEOUT_S:g} s, and was stopped'
    return ''
