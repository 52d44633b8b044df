# SPDX-License-Identifier: Apache-2.0
"""The paths and the HTML of embedded pages, put together from the files in the folder `web`."""

from __future__ import annotations

from importlib.resources import files
from typing import Any

from rviz_common.page.web_files import filled

__all__ = ['page_text', 'path_of']

COMMON = ('common.css', 'link.js', 'live.css', 'live.js', 'person.js', 'stay.js')
OF_SAFETY = ('safety.css', 'safety.js', 'stop.html')
OF_DRIVE = ('drive.css', 'drive.js', 'stick.html')


def path_of(name: str, namespace: str) -> str:
    """
    Return the path at which an embedded page of a robot is served.

    Parameters
    ----------
    name
        The name of the page.
    namespace
        The namespace of the robot; '' if there is only one.

    """
    return f'/{name}/{namespace}' if namespace else f'/{name}'


def page_text(name: str, settings: dict[str, Any], package: str = 'robot_console') -> str:
    """
    Read the HTML of an embedded page, and insert shared styles, scripts, markup and settings.

    Parameters
    ----------
    name
        The name of the file in the folder `web`, without `.html`.
    settings
        The value of `settings` in the scripts of the page; must be serializable as JSON.
    package
        The package that contains the file.

    """
    folder = files('robot_console') / 'web'
    text = (files(package) / 'web' / f'{name}.html').read_text(encoding='utf-8')
    for part in (*COMMON, *OF_SAFETY, *OF_DRIVE):
        mark = f'<!-- {part} -->' if part.endswith('.html') else f'/* {part} */'
        if mark in text:
            text = text.replace(mark, (folder / part).read_text(encoding='utf-8'))
    return filled(text, settings)
