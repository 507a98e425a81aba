// The project's templates, one of which is taken; more are uploaded by choosing or dropping files.
import { FileBox, Upload } from "lucide-react";
import { type DragEvent, useRef, useState } from "react";
import { runInTurn } from "../../commands/queue";
import { api } from "../../server/api";
import { useProject } from "../../store/project";
import { reportError } from "../../store/toasts";
import { Button } from "../../ui/Button";
import css from "./demonstrate.module.css";

export function TemplateField({ value, onChange }: { value: string; onChange: (value: string) => void }) {
  const templates = useProject((state) => state.project.templates);
  const input = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);
  const [sending, setSending] = useState(false);
  const all = value && !templates.includes(value) ? [...templates, value] : templates;
  const take = async (files: readonly File[]) => {
    setSending(true);
    const name = await uploadAll(files);
    setSending(false);
    if (name !== null) onChange(name);
  };
  // the list is emptied while its files are on their way
  const receive = (list: FileList) => {
    const files = [...list];
    runInTurn(() => take(files));
  };
  const drag = (is: boolean) => (event: DragEvent) => {
    event.preventDefault();
    event.stopPropagation();
    setOver(is);
  };
  return (
    <div
      className={css.templates}
      data-over={over || undefined}
      data-drop-templates
      onDragEnter={drag(true)}
      onDragOver={drag(true)}
      onDragLeave={drag(false)}
      onDrop={(event) => {
        drag(false)(event);
        receive(event.dataTransfer.files);
      }}
    >
      {all.map((name) => (
        <button
          key={name}
          type="button"
          className={css.template}
          aria-pressed={value === name}
          onClick={() => onChange(name)}
          title={name}
        >
          <FileBox size={15} aria-hidden />
          <span>{name}</span>
        </button>
      ))}
      <Button
        icon={Upload}
        look="quiet"
        disabled={sending}
        onClick={() => input.current?.click()}
        tip="Mesh files of one or more convex hulls; they can be dropped here, too"
      >
        {sending ? "Uploading…" : templates.length ? "Upload…" : "Upload a template…"}
      </Button>
      <input
        ref={input}
        type="file"
        multiple
        hidden
        aria-label="Template files"
        onChange={(event) => {
          if (event.target.files) receive(event.target.files);
          event.target.value = "";
        }}
      />
    </div>
  );
}

/** Uploads files one by one; the name of the first that was taken. */
async function uploadAll(files: readonly File[]): Promise<string | null> {
  let first: string | null = null;
  for (const file of files) {
    try {
      const { names } = await api.uploadTemplate(file);
      first ??= names[0] ?? null;
    } catch (error) {
      reportError(error);
    }
  }
  return first;
}
