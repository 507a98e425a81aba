"""Asking a vision-language model behind any OpenAI-compatible address: a client for any question, and a labeller."""

from __future__ import annotations

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "label_by_vlm": "VlmForecast VlmResult forecast_vlm label_with_vlm",
        "limits": "Usage",
    },
)
