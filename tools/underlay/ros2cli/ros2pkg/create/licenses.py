# SPDX-License-Identifier: Apache-2.0
"""Licences with available texts."""

from __future__ import annotations

from datetime import date
from pathlib import Path

TEXTS = Path(__file__).parent / 'license_texts'


def known_licenses() -> list[str]:
    """Return the SPDX identifiers of all licences with a text, sorted."""
    return sorted(path.stem for path in TEXTS.glob('*.txt'))


def license_text(identifier: str, holder: str) -> str | None:
    """
    Load the text of a licence.

    Parameters
    ----------
    identifier
        Its SPDX identifier.
    holder
        The copyright holder; with the current year, it is filled into MIT and BSD licences.

    Returns
    -------
    str or None
        The text, or None for an unknown licence.

    """
    if identifier not in known_licenses():
        return None
    text = (TEXTS / f'{identifier}.txt').read_text(encoding='utf-8')
    if identifier.startswith(('MIT', 'BSD')):
        text = text.replace('<year>', str(date.today().year)).replace('<holder>', holder)
    return text


def unknown_license_warning(identifier: str) -> str:
    """
    Format the warning about an unknown licence, with a list of the known ones.

    Parameters
    ----------
    identifier
        The licence as the user wrote it.

    """
    choices = '\n'.join(known_licenses())
    return (
        f"\n[WARNING]: Unknown license '{identifier}'.  This has been set in the package.xml, "
        'but no LICENSE file has been created.\n'
        f'It is recommended to use one of the ament license identifiers:\n{choices}'
    )
