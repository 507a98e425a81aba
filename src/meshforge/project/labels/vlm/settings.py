"""The table [vlm] of meshforge.toml: which model is asked for labels, and how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

if TYPE_CHECKING:
    from meshforge.perception.vlm import Endpoint, Manner

Price = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Seconds = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class VlmSettings(BaseModel):
    """Prices in dollars a million tokens; all else as of `Endpoint` and `Manner`. The key is never written here.

    max_cost: the most that one run may cost [$]; examples: ids of labelled assets that the model is shown.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    base_url: str = "https://api.openai.com/v1"
    model: str = ""
    key_env: str | None = None
    mode: Literal["cheap", "balanced", "exact"] = "balanced"
    about: str = ""
    descriptions: Mapping[str, str] = {}
    examples: tuple[str, ...] = ()
    names: bool = False
    repeats: Annotated[int, Field(ge=1, le=20)] = 1
    input_price: Price | None = None
    output_price: Price | None = None
    max_cost: Price | None = None
    room: Annotated[int, Field(ge=100)] = 1000
    size: Annotated[int, Field(ge=256, le=4096)] | None = None
    concurrency: Annotated[int, Field(ge=1, le=256)] = 4
    timeout: Seconds = 120.0
    retries: Annotated[int, Field(ge=0, le=20)] = 5
    wait: Seconds = 1.0
    extra: Mapping[str, Any] = {}

    def check(self, vocabulary: Sequence[str]) -> None:
        """Raises UsageError for what is in the way of asking: no model, no key, no vocabulary."""
        self.endpoint().key()
        self.manner(vocabulary)

    def endpoint(self) -> Endpoint:
        """Where the model is asked. Raises UsageError: no address, or no model named."""
        from meshforge.perception.vlm import Endpoint

        return Endpoint(
            base_url=self.base_url,
            model=self.model,
            key_env=self.key_env,
            input_price=self.input_price,
            output_price=self.output_price,
            concurrency=self.concurrency,
            timeout=self.timeout,
            retries=self.retries,
            wait=self.wait,
            extra=self.extra,
        )

    def manner(self, vocabulary: Sequence[str]) -> Manner:
        """How it is asked. Raises UsageError: no vocabulary, or a description of what is no label."""
        from meshforge.perception.vlm import Manner

        return Manner(
            vocabulary=tuple(vocabulary),
            mode=self.mode,
            descriptions=self.descriptions,
            about=self.about,
            names=self.names,
            repeats=self.repeats,
            room=self.room,
            size=self.size,
        )
