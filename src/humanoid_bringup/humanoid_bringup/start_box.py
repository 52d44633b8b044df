# SPDX-License-Identifier: Apache-2.0
"""What a terminal shows once the robot has started: its page, what to try, and how to stop it."""

from __future__ import annotations

from dataclasses import dataclass
import ipaddress
import os
import shutil
import sys
from urllib.parse import urlsplit

__all__ = ['Terminal', 'is_shared', 'qr_code', 'start_box']

WALK = "ros2 topic pub -r 10 /cmd_vel geometry_msgs/msg/Twist '{linear: {x: 0.2}}'"
TELL = 'ros2 topic pub --once /user_command std_msgs/msg/String \'{{data: "{}"}}\''
STOP = 'Ctrl-C in this terminal stops the robot and everything else.'
SCAN = 'or, on a phone in the same network, by scanning the code below.'

_LINES, _ASCII = '┌┐└┘─│', '++++-|'
_QUIET = 4
"""Width of the light margin of a QR code, in modules, as the standard demands."""
_BLACK_ON_WHITE, _PLAIN = '\x1b[38;5;16;48;5;231m', '\x1b[0m'
_BLOCKS = ' ▄▀█'
"""Two modules in one character; the upper one counts two, the lower one counts one."""


@dataclass(frozen=True)
class Terminal:
    """The width and the abilities of what shows the output; columns are characters."""

    columns: int = 80
    encoding: str = 'utf-8'
    has_colors: bool = False

    @classmethod
    def of_output(cls) -> Terminal:
        """Examine the standard output of this process; what is no terminal has no colors."""
        stream = sys.stdout
        try:
            is_terminal = stream is not None and stream.isatty()
        except ValueError:  # it is closed
            is_terminal = False
        columns = shutil.get_terminal_size().columns
        encoding = getattr(stream, 'encoding', None) or 'ascii'
        return cls(columns, encoding, is_terminal and os.environ.get('TERM') != 'dumb')

    def can_show(self, text: str) -> bool:
        """
        Whether the encoding of the output has all characters of a text.

        Parameters
        ----------
        text
            The text.

        """
        try:
            text.encode(self.encoding)
        except (UnicodeEncodeError, LookupError):
            return False
        return True


def start_box(url: str, sentence: str, has_code: bool, terminal: Terminal) -> str:
    """
    Format the box that is shown once the robot has started.

    A line that is longer than the terminal is wide would break the sides of the box: then it
    consists of a line above and one below. Commands and the address are never wrapped.

    Parameters
    ----------
    url
        The address of the page; '' without a page.
    sentence
        What the robot can be told to do; '' if nothing understands it.
    has_code
        Whether a QR code of the address follows.
    terminal
        Where it is shown.

    Returns
    -------
    str
        Lines, each at most as wide as the terminal unless an address or a command is longer.

    """
    lines = _lines(url, sentence, has_code)
    width = max(map(len, lines))
    corners = _LINES if terminal.can_show(_LINES) else _ASCII
    top_left, top_right, bottom_left, bottom_right, rule, side = tuple(corners)
    if width + 4 > terminal.columns:
        rules = rule * min(width, terminal.columns)
        return '\n'.join([rules, *lines, rules])
    rules = rule * (width + 2)
    inside = [f'{side} {line.ljust(width)} {side}' for line in lines]
    top, bottom = f'{top_left}{rules}{top_right}', f'{bottom_left}{rules}{bottom_right}'
    return '\n'.join([top, *inside, bottom])


def _lines(url: str, sentence: str, has_code: bool) -> list[str]:
    """Return what the box says."""
    if url:
        lines = ['The robot has started. See it, and drive it in the Drive tab, at', f'  {url}']
        lines += [SCAN] if has_code else []
    else:
        lines = ['The robot has started, without a page.']
    lines += ['In another terminal, with the workspace sourced, this makes it walk:', f'  {WALK}']
    if sentence and url:
        lines += ['When it is ready, tell it in the Command tab, for example:', f'  {sentence}']
    elif sentence:
        command = TELL.format(sentence)
        lines += ['When it is ready, tell it what to do, for example:', f'  {command}']
    return [*lines, STOP]


def is_shared(url: str) -> bool:
    """
    Whether the host of an address is one that other machines can reach.

    Parameters
    ----------
    url
        The address of a page; its host is an IP address.

    """
    try:
        return not ipaddress.ip_address(urlsplit(url).hostname or '').is_loopback
    except ValueError:
        return False


def qr_code(url: str, terminal: Terminal) -> str:
    """
    Draw the QR code of an address, two modules in a character, in black on white if possible.

    Without colors, light modules are drawn, as the background of most terminals is dark.

    Parameters
    ----------
    url
        The address.
    terminal
        Where it is shown.

    Returns
    -------
    str
        Lines; '' if the terminal is too narrow or lacks the characters, or if the Python package
        segno is not installed.

    """
    if not terminal.can_show(_BLOCKS):
        return ''
    try:
        from segno import make
    except ImportError:
        return ''
    rows = [[int(bit) for bit in row] for row in make(url, micro=False).matrix_iter(border=_QUIET)]
    if len(rows[0]) > terminal.columns:
        return ''
    rows += [[0] * len(rows[0])] if len(rows) % 2 else []
    blocks = _BLOCKS if terminal.has_colors else _BLOCKS[::-1]
    lines = [
        ''.join(blocks[2 * upper + lower] for upper, lower in zip(above, below))
        for above, below in zip(rows[::2], rows[1::2])
    ]
    if terminal.has_colors:
        lines = [f'{_BLACK_ON_WHITE}{line}{_PLAIN}' for line in lines]
    return '\n'.join(lines)
