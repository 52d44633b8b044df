# SPDX-License-Identifier: Apache-2.0
"""Decoding of untrusted strings from the network."""

from __future__ import annotations


def text_of(raw: bytes) -> str:
    """
    Decode a string from the network; control characters are escaped, to protect the terminal.

    Parameters
    ----------
    raw
        UTF-8, with or without trailing zeros.

    """
    text = raw.rstrip(b'\0').decode('utf-8', 'backslashreplace')
    if text.isprintable():
        return text
    return ''.join(each if each.isprintable() else ascii(each)[1:-1] for each in text)
