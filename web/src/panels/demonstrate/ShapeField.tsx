// A primitive or a template.
import { Box, Circle, Cylinder, type LucideIcon, Pill } from "lucide-react";
import css from "./demonstrate.module.css";
import { TemplateField } from "./TemplateField";

const ICONS: Readonly<Record<string, LucideIcon>> = { box: Box, cylinder: Cylinder, capsule: Pill, sphere: Circle };

interface ShapeFieldProps {
  primitives: readonly string[];
  value: string;
  onChange: (value: string) => void;
}

export function ShapeField({ primitives, value, onChange }: ShapeFieldProps) {
  return (
    <>
      <div className={css.shapes}>
        {primitives.map((shape) => {
          const Icon = ICONS[shape] ?? Box;
          return (
            <button
              key={shape}
              type="button"
              className={css.shape}
              aria-pressed={value === shape}
              onClick={() => onChange(shape)}
            >
              <Icon size={18} aria-hidden />
              {shape}
            </button>
          );
        })}
      </div>
      <TemplateField value={primitives.includes(value) ? "" : value} onChange={onChange} />
    </>
  );
}
