# SPDX-License-Identifier: Apache-2.0
"""Read scalars by the rules of YAML 1.1, without loading a YAML parser where it can be avoided."""

from __future__ import annotations

import re
from typing import Any

_TRUE = frozenset(('true', 'True', 'TRUE', 'yes', 'Yes', 'YES', 'on', 'On', 'ON'))
_FALSE = frozenset(('false', 'False', 'FALSE', 'no', 'No', 'NO', 'off', 'Off', 'OFF'))
_NOTHING = frozenset(('null', 'Null', 'NULL'))
_DECIMAL = re.compile(r'[-+]?(?:0|[1-9][0-9]*)')
_POINT = re.compile(r'[-+]?[0-9]+\.[0-9]*(?:[eE][-+][0-9]+)?')
EXPONENT = re.compile(r'[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)[eE][-+]?[0-9]+')
_PLAIN_WORD = re.compile(r'[A-Za-z/_][A-Za-z0-9/_.-]*')


def read_yaml(text: str) -> Any:
    """
    Parse a YAML 1.1 document; the common scalars need no YAML parser.

    Parameters
    ----------
    text
        The document.

    Returns
    -------
    Any
        The parsed value: a scalar, a list, a dictionary or None.

    Raises
    ------
    ValueError
        The document is not valid YAML.

    """
    if text in _TRUE:
        return True
    if text in _FALSE:
        return False
    if _DECIMAL.fullmatch(text):
        return int(text)
    if _POINT.fullmatch(text):
        return float(text)
    if _PLAIN_WORD.fullmatch(text) and text not in _NOTHING:
        return text
    import yaml

    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(f"'{text}' is not YAML: {error}") from error


def read_value(text: str) -> Any:
    """
    Parse a YAML document, but read `1e3` as a number, as YAML 1.2 and ROS do.

    Parameters
    ----------
    text
        The document.

    Returns
    -------
    Any
        As for `read_yaml`.

    Raises
    ------
    ValueError
        The document is not valid YAML.

    """
    return float(text) if EXPONENT.fullmatch(text) else read_yaml(text)


def read_boolean(text: str) -> bool:
    """
    Parse a boolean: true, false, yes, no, on, off, 1 or 0.

    Parameters
    ----------
    text
        The word, with any space around it; true may be True or TRUE, and the others likewise.

    Raises
    ------
    ValueError
        It is none of these words.

    """
    word = text.strip()
    if word in _TRUE or word == '1':
        return True
    if word in _FALSE or word == '0':
        return False
    raise ValueError(
        f"cannot read '{text}' as a boolean: expected true, false, yes, no, on, off, 1 or 0"
    )
