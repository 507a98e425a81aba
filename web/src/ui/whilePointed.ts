// What happens while one points at a part of the page, by the pointer or by the focus.
export const whilePointed = (on: () => void, off: () => void) => ({
  onPointerEnter: on,
  onPointerLeave: off,
  onFocus: on,
  onBlur: off,
});
