# SPDX-License-Identifier: Apache-2.0
"""
Pronunciations of fluent American English that CMUdict does not have.

Weak forms of function words: J. C. Wells, "Accents of English" (1982), chapter 3. The vowel of
"hall" is that of "hot" for about half of the speakers (the cot-caught merger): W. Labov, S. Ash
and C. Boberg, "The Atlas of North American English" (2006), chapter 9. "Ball" is left out, since
it would then sound too much like "bottle".
"""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ['FLUENT']

FLUENT: Mapping[str, str] = {
    'and': 'AH N',
    'at': 'AH T',
    'do': 'D AH',
    'her': 'ER',
    'it': 'AH T',
    'of': 'AH',
    'you': 'Y AH',
    'your': 'Y ER',
    'all': 'AA L',
    'corridor': 'K AO R AH D AO R',
    'hall': 'HH AA L',
    'small': 'S M AA L',
    'tall': 'T AA L',
    'walk': 'W AA K',
    'what': 'W AA T',
}
"""The phones of another pronunciation, by word."""
