# Written by `python -m script.stubs`.
from meshforge.labels.vlm.label_by_vlm import VlmForecast as VlmForecast
from meshforge.labels.vlm.label_by_vlm import VlmResult as VlmResult
from meshforge.labels.vlm.label_by_vlm import forecast_vlm as forecast_vlm
from meshforge.labels.vlm.label_by_vlm import label_with_vlm as label_with_vlm
from meshforge.labels.vlm.limits import Usage as Usage
