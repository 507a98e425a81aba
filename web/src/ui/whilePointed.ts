// What happens while one points at a part of the page, by the pointer or by the focus.
interface Pointing {
  onPointerEnter: () => void;
  onPointerLeave: () => void;
  onFocus: () => void;
  onBlur: () => void;
}

export const whilePointed = (on: () => void, off: () => void): Pointing => ({
  onPointerEnter: on,
  onPointerLeave: off,
  onFocus: on,
  onBlur: off,
});
