# SPDX-License-Identifier: Apache-2.0
"""Rendering of the joint table as HTML, kept short because it is sent several times a second."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from math import degrees

from robot_console.joints.joint_row import JointRow, load_level, position_level
from robot_console.joints.joint_table import RowGroup
from rviz_common.status import Level

__all__ = ['STYLE', 'notes_html', 'table_html']

MAX_ROWS = 300
NONE = '<td>'
CLASSES = {Level.OK: '', Level.WARN: ' w', Level.ERROR: ' e'}
ERROR_RAD, ERROR_M = 0.1, 0.01

STYLE = """<style>
.joints{width:calc(100% - 22px);margin:0 10px 10px 12px;border-collapse:collapse;
font-size:11px;line-height:1.25;font-variant-numeric:tabular-nums}
.joints th{font-weight:600;text-align:right;padding:2px 3px;opacity:.7;border:0}
.joints th:first-child,.joints td:first-child{text-align:left;white-space:nowrap;
overflow:hidden;text-overflow:ellipsis;max-width:9em}
.joints small{display:block;font-weight:400}
.joints .g td{font-weight:700;padding-top:7px;text-align:left}
.joints td{text-align:right;padding:2px 3px;border-bottom:1px solid rgba(128,128,128,.2);
white-space:nowrap}
.joints i{display:inline-block;min-width:4.2em;font-style:normal;opacity:.65}
.joints .p{background:linear-gradient(90deg,transparent calc(var(--t,-9px) - 1px),#e8a33d 0,
#e8a33d calc(var(--t,-9px) + 1px),transparent 0),linear-gradient(90deg,transparent
calc(var(--p) - 2px),var(--c,#4dabf7) 0,var(--c,#4dabf7) calc(var(--p) + 2px),transparent 0),
linear-gradient(rgba(128,128,128,.16) 0 0);background-size:100% 4px;
background-repeat:no-repeat;background-position:0 100%}
.joints .b{background:linear-gradient(90deg,var(--c,#4dabf7) var(--p),rgba(128,128,128,.16) 0)
no-repeat 0 100%/100% 4px}
.joints .w{--c:#fab005;color:#fab005}.joints .e{--c:#ff6b6b;color:#ff6b6b;font-weight:700}
.joints .s{opacity:.4}
.joint-notes{margin:0 12px 4px;font-size:11px;line-height:1.4}.joint-notes .w{color:#fab005}
</style>"""

HEAD = (
    '<tr><th>Joint<th>Position<small>rad</small><th>Error<small>rad</small>'
    '<th>Velocity<small>rad/s</small><th>Effort<small>N m</small>'
)


def table_html(groups: Iterable[RowGroup]) -> str:
    """
    Render the joint table as HTML.

    Parameters
    ----------
    groups
        The rows by limb; rows beyond the first 300 are only counted.

    Returns
    -------
    str
        The table; '' if there are no joints.

    """
    parts = []
    left = MAX_ROWS
    left_out = 0
    for group in groups:
        rows = group.rows[:left]
        left -= len(rows)
        left_out += len(group.rows) - len(rows)
        if rows:
            parts.append(f'<tr class=g><td colspan=5>{escape(group.title)}')
            parts.extend(map(_row, rows))
    more = f'<tr><td colspan=5>{left_out} more; search for some.' if left_out else ''
    body = ''.join(parts)
    return f'<table class=joints>{HEAD}{body}{more}</table>' if body else ''


def notes_html(notes: Iterable[tuple[str, bool]]) -> str:
    """
    Render the notes above the joint table as HTML.

    Parameters
    ----------
    notes : Iterable[tuple[str, bool]]
        Messages, each with whether it is a warning.

    """
    lines = ''.join(
        f'<div class=w>⚠ {escape(text)}</div>' if is_warning else f'<div>{escape(text)}</div>'
        for text, is_warning in notes
    )
    return f'<div class=joint-notes>{lines}</div>'


def _row(row: JointRow) -> str:
    state, joint = row.state, row.joint
    velocity = _load(state.velocity, joint.max_velocity if joint else None, 2)
    effort = _load(state.effort, joint.max_effort if joint else None, 1)
    kind = ' class=s' if row.is_stale else ''
    return f'<tr{kind}><td>{escape(row.label)}{_position(row)}{_error(row)}{velocity}{effort}'


def _position(row: JointRow) -> str:
    position = row.state.position
    if position is None:
        return NONE
    text = f'{position:.3f}<i>{_turned(position)}</i>' if row.is_angle else f'{position:.4f} m'
    share = row.share(position)
    if share is None:
        return f'<td>{text}'
    target = row.share(row.target)
    told = '' if target is None else f';--t:{100 * target:.0f}%'
    level = CLASSES[position_level(row)]
    return f'<td class="p{level}" style="--p:{100 * share:.0f}%{told}">{text}'


def _turned(position: float) -> str:
    return f'{degrees(position):.1f}°'


def _error(row: JointRow) -> str:
    error = row.error
    if error is None:
        return NONE
    is_large = abs(error) > (ERROR_RAD if row.is_angle else ERROR_M)
    return f'<td{" class=w" if is_large else ""}>{error:.3f}'


def _load(value: float | None, maximum: float | None, digits: int) -> str:
    """Render a cell with a bar proportional to the fraction of the maximum."""
    if value is None:
        return NONE
    text = f'{value:.{digits}f}'
    text = text.lstrip('-') if float(text) == 0.0 else text
    if maximum is None:
        return f'<td>{text}'
    share = min(100 * abs(value) / maximum, 100)
    level = CLASSES[load_level(value, maximum)]
    return f'<td class="b{level}" style="--p:{share:.0f}%">{text}'
