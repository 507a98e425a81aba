"""The messages between server and page: the types of both sides come from here. `Wire` is their base."""

from pydantic import BaseModel, ConfigDict


class Wire(BaseModel):
    """A message, or a part of one; the page's TypeScript types are made from these classes by `script/make-wire`."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", from_attributes=True, json_schema_serialization_defaults_required=True
    )
