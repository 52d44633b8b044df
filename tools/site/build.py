# SPDX-License-Identifier: Apache-2.0
"""Build the documentation as a site in site/: `make site`."""

from __future__ import annotations

from pathlib import Path
import re
import shutil
import subprocess
import sys

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / 'tools' / 'reference'))

from contents import SiteError  # noqa: E402
from pages import write_pages  # noqa: E402

WORK = ROOT / 'build' / 'site'
SITE = ROOT / 'site'
FOREIGN = re.compile(
    r'<(?:script|link|img|source|iframe)\b[^>]*\b(?:src|href)="((?:https?:)?//[^"]*)'
)


def main() -> int:
    """Build the site, put it into place if it is without fault, and return the exit status."""
    shutil.rmtree(WORK, ignore_errors=True)
    try:
        shown = write_pages(ROOT, WORK / 'pages')
        run_sphinx(WORK / 'pages', WORK / 'html', shown)
        require_local(WORK / 'html')
    except SiteError as error:
        print(error, file=sys.stderr)
        return 1
    shutil.rmtree(SITE, ignore_errors=True)
    (WORK / 'html').rename(SITE)
    print(f'The site is complete: open {SITE / "index.html"}')
    return 0


def run_sphinx(sources: Path, html: Path, shown: dict[str, str]) -> None:
    """
    Make HTML of the pages.

    Parameters
    ----------
    sources, html
        The folders of the pages and of the result.
    shown
        The file of the workspace that each page shows, which warnings name instead.

    Raises
    ------
    SiteError
        Sphinx has failed or has warned of something; the message quotes it.

    """
    options = ['-q', '-W', '--keep-going', '-j', 'auto', '-c', str(Path(__file__).parent)]
    options += ['-d', str(WORK / 'doctrees')]
    done = subprocess.run(
        [sys.executable, '-m', 'sphinx', *options, str(sources), str(html)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding='utf-8',
        check=False,
    )
    if done.returncode:
        said = re.sub(
            re.escape(f'{sources}/') + r'([^\s:]+)',
            lambda match: shown.get(match[1], match[0]),
            done.stdout,
        )
        raise SiteError(f'{said.strip()}\nThe site is not built: mend these first.')


def require_local(html: Path) -> None:
    """
    Check that a browser loads nothing of the site from another host.

    Parameters
    ----------
    html
        The folder of the site.

    Raises
    ------
    SiteError
        A page does; the message names each address.

    """
    found = [
        f'{path.relative_to(html)} loads {address}: put a copy into the workspace instead'
        for path in sorted(html.rglob('*.html'))
        for address in FOREIGN.findall(path.read_text(encoding='utf-8'))
    ]
    if found:
        raise SiteError('\n'.join(found))


if __name__ == '__main__':
    sys.exit(main())
