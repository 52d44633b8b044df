# SPDX-License-Identifier: Apache-2.0
"""
Main program of the template: import the modules of programs, then run each of them in a clone.

It is run by its path, so that it finds the `launch` that has started it:
`template.py DESCRIPTOR PRELOADER SCRIPT...`. The code at the bottom of this file is executed with
only this module below it on the stack, in a clone that has returned from `serve`.
"""

from __future__ import annotations

from collections.abc import Callable
import os
import sys
from typing import Any


def _serve() -> Callable[[], tuple[Any, ...]]:
    """Wait for requests; in a clone, return a function that provides the arguments of `exec`."""
    folder = os.path.dirname(os.path.abspath(__file__))
    if not getattr(sys.flags, 'safe_path', False):
        del sys.path[0]
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(folder))))
    import launch._supervision

    del sys.path[0]
    from launch._supervision.prefork.service import serve

    assert launch
    return serve(int(sys.argv[1]), sys.argv[2], sys.argv[3:])


def _without_template(display: Any) -> Any:
    """Create an excepthook for one use that hides the frames of the template."""
    own = os.path.dirname(os.path.abspath(__file__))

    def show(kind: Any, error: Any, traceback: Any) -> None:
        sys.excepthook = display
        while traceback and traceback.tb_frame.f_code.co_filename.startswith(own):
            traceback = traceback.tb_next
        error.__traceback__ = sys.last_traceback = traceback
        display(kind, error, traceback)

    return show


if __name__ == '__main__':
    try:
        _become = _serve()
        exec(*_become())  # noqa: S102
    except SystemExit:
        raise
    except BaseException:
        sys.excepthook = _without_template(sys.excepthook)
        raise
