"""Asking a vision-language model behind any OpenAI-compatible address: a client for any question, and a labeller."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.labels.vlm.label_by_vlm import VlmForecast, VlmResult, forecast_vlm, label_with_vlm
    from meshforge.labels.vlm.limits import Usage
else:
    __getattr__ = export_lazily(__name__)

__all__ = ["Usage", "VlmForecast", "VlmResult", "forecast_vlm", "label_with_vlm"]
