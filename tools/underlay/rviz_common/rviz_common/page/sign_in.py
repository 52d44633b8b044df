# SPDX-License-Identifier: Apache-2.0
"""The sign-in page shown to users without the token."""

from __future__ import annotations

from html import escape
import string

__all__ = ['sign_in_page']

PAGE = string.Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>$title: token needed</title>
<style>
  :root { color-scheme: dark; }
  body { margin: 0; background: #1a1b1e; color: #c9cbcf; font: 16px/1.5 system-ui, sans-serif; }
  main { max-width: 36rem; margin: 12vh auto 0; padding: 0 1.5rem; }
  h1 { color: #fff; font-size: 1.5rem; }
  code { color: #fff; background: #2c2e33; border-radius: 4px; padding: .1em .35em; }
  code { overflow-wrap: anywhere; }
  form { display: flex; gap: .5rem; margin: 1.5rem 0; }
  input { flex: 1; min-width: 0; }
  input, button { font: inherit; padding: .5rem .75rem; border-radius: 4px; }
  input { color: #fff; background: #25262b; border: 1px solid #5c5f66; }
  button { color: #fff; background: #1971c2; border: 0; cursor: pointer; }
</style>
</head>
<body>
<main>
<h1>$heading</h1>
<p>Who opens this page can drive a robot, so its address has a token that is new at each start.
Open the whole address that was printed in the terminal where this was started:</p>
<p><code>$title is at http://$host/?token=...</code></p>
<p>or put the token in here. This browser keeps it until the next start.</p>
<form action="/" method="get">
<input name="token" aria-label="Token" placeholder="Token" autocomplete="off" autofocus required>
<button>Open</button>
</form>
<p>The terminal is out of sight? The log has the address as well; on the machine where it runs:</p>
<p><code>grep -rh 'at http://.*token=' ~/.ros/log</code></p>
<p>Choose a token with <code>token:=TEXT</code>, or do without one on a machine that is yours alone
with <code>token:=none</code>.</p>
</main>
</body>
</html>
""")


def sign_in_page(title: str, host: str, heading: str) -> str:
    """
    Return the HTML of the page that asks for a token.

    Parameters
    ----------
    title
        The title of the page that it leads to.
    host
        The host name that the browser used, with the port.
    heading
        What is missing or wrong.

    """
    return PAGE.substitute(title=escape(title), host=escape(host), heading=escape(heading))
