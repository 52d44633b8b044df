# SPDX-License-Identifier: Apache-2.0
"""
Client for language model servers with an OpenAI-compatible API: OpenAI, Ollama, llama.cpp, vLLM.

Only `chat/completions` and `models` are used. Servers differ in how they can be made to answer in
JSON: by a schema, as any object, or not at all. The first mode that works is kept.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
import json
import re
import time
from typing import Any

import httpx
from humanoid_common.naming import shortened
from llm_planner.model_planner import ModelError

__all__ = ['ModelServer']

Message = Mapping[str, str]
_MODES = ('json_schema', 'json_object', 'text')
_LARGEST = 1_000_000
_MOST_TOKENS = 800
_NAMED = 8
"""How many models a message lists."""
_CONNECT_S = 3.0
_UNKNOWN_MODEL = re.compile(
    r'model_not_found|invalid_model|(?:invalid|unknown|no such) model\b|not a valid model\b'
    r'|\bmodel (?:\S+ )?(?:is |was |has been |does )?'
    r'(?:not found|not exist|not available|unavailable|unknown|retired|deprecated)\b',
    re.IGNORECASE,
)
"""How servers that answer an unknown model with status 400 word the error."""


class ModelServer:
    """
    Client of a language model server.

    Parameters
    ----------
    base_url
        The base URL of the API: `http://127.0.0.1:11434/v1`.
    model
        The name of the model; empty for the only one that the server has.
    key
        The API key; empty if the server requires none. It is sent, but never shown.
    mode
        How JSON output is requested: `json_schema`, `json_object` or `text`; `auto` for the first
        of these that the server accepts.

    """

    def __init__(self, base_url: str, model: str = '', key: str = '', mode: str = 'auto') -> None:
        self._url = base_url.rstrip('/')
        self._model = model
        headers = {'Authorization': f'Bearer {key}'} if key else {}
        self._client = httpx.Client(headers=headers)
        self._modes = list(_MODES) if mode == 'auto' else [mode]

    def answer(
        self, messages: Sequence[Message], schema: Mapping[str, Any], deadline_s: float
    ) -> str:
        """
        Request a chat completion from the model.

        Parameters
        ----------
        messages
            The conversation: roles and contents.
        schema
            The JSON schema of the answer, for servers that support one.
        deadline_s
            The deadline for all requests together, by `time.monotonic`.

        Raises
        ------
        ModelError
            The server gives no answer, or none in time.

        """
        model = self._model or self._only_model(deadline_s)
        while True:
            body = {
                'model': model,
                'messages': list(messages),
                'temperature': 0,
                'max_tokens': _MOST_TOKENS,
                **_format(self._modes[0], schema),
            }
            status, text = self._request('POST', 'chat/completions', deadline_s, body)
            if status == 400 and len(self._modes) > 1 and 'response_format' in text:
                del self._modes[0]
                continue
            if status == 404 or (status == 400 and _UNKNOWN_MODEL.search(text)):
                raise ModelError(self._unknown(model, deadline_s))
            self._check(status, text)
            return _content(text)

    def _only_model(self, deadline_s: float) -> str:
        names = self._models(deadline_s)
        if len(names) == 1:
            self._model = names[0]
            return names[0]
        if not names:
            raise ModelError(f'The server at {self._url} has no models: load one there.')
        raise ModelError(
            f'The server at {self._url} has several models: {_some(names)}. Choose one with '
            'the parameter model.'
        )

    def _models(self, deadline_s: float) -> list[str]:
        status, text = self._request('GET', 'models', deadline_s)
        self._check(status, text)
        try:
            names = [str(each['id']) for each in json.loads(text)['data']]
        except (ValueError, KeyError, TypeError):
            raise ModelError(
                f'The server at {self._url} does not list any models. Is the parameter base_url '
                'right? It often ends in /v1.'
            ) from None
        return names

    def _unknown(self, model: str, deadline_s: float) -> str:
        """Build the error message for an unknown model, with the names of those available."""
        try:
            names = self._models(deadline_s)
        except ModelError:
            names = []
        offer = f' It has: {_some(names)}.' if names else ' Is the parameter base_url right?'
        return f"The server at {self._url} has no model '{shortened(model)}'.{offer}"

    def _check(self, status: int, text: str) -> None:
        """Raise ModelError for an HTTP error status."""
        if status in (401, 403):
            raise ModelError(
                f'The server at {self._url} does not accept the key: set OPENAI_API_KEY in the '
                'environment of the planner.'
            )
        if status == 429:
            raise ModelError(
                f'The server at {self._url} rejected the request: too many requests, or no credit.'
            )
        if status >= 300:
            raise ModelError(f'The server at {self._url} failed with status {status}.')

    def _request(
        self, method: str, path: str, deadline_s: float, body: Any = None
    ) -> tuple[int, str]:
        """Send a request; return the status and text of a response within the deadline."""
        left_s = deadline_s - time.monotonic()
        late = ModelError(f'The server at {self._url} did not answer in time.')
        if left_s <= 0.0:
            raise late
        timeout = httpx.Timeout(left_s, connect=min(left_s, _CONNECT_S))
        received = bytearray()
        try:
            with self._client.stream(
                method, f'{self._url}/{path}', json=body, timeout=timeout
            ) as response:
                for part in response.iter_bytes():
                    received += part
                    if len(received) > _LARGEST:
                        raise ModelError(f'The answer of {self._url} is too long.')
                    if time.monotonic() > deadline_s:  # the response trickles in
                        raise late
                return response.status_code, received.decode(errors='replace')
        except httpx.TimeoutException:
            raise late from None
        except (httpx.HTTPError, httpx.InvalidURL) as error:
            raise ModelError(
                f'The server at {self._url} cannot be reached ({type(error).__name__}). Is it '
                'running, and is the parameter base_url right?'
            ) from None


def _format(mode: str, schema: Mapping[str, Any]) -> dict[str, Any]:
    if mode == 'text':
        return {}
    if mode == 'json_object':
        return {'response_format': {'type': 'json_object'}}
    named = {'name': 'plan', 'strict': True, 'schema': schema}
    return {'response_format': {'type': 'json_schema', 'json_schema': named}}


def _content(text: str) -> str:
    """Extract the text that the model wrote from a chat completion."""
    try:
        message = json.loads(text)['choices'][0]['message']
        content = message['content']
    except (ValueError, KeyError, IndexError, TypeError, RecursionError):
        raise ModelError('The answer of the server is not a chat completion.') from None
    if not isinstance(content, str) or not content.strip():
        refusal = message.get('refusal') if isinstance(message, dict) else None
        raise ModelError(str(refusal)[:200] if refusal else 'The answer of the model is empty.')
    return content


def _some(names: Sequence[str]) -> str:
    more = f' and {len(names) - _NAMED} more' if len(names) > _NAMED else ''
    return ', '.join(shortened(each) for each in names[:_NAMED]) + more
