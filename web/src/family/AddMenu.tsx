// Adding assets from files or a folder.
import { Plus } from "lucide-react";
import { type RefObject, useRef } from "react";
import { addAssets } from "../store/adding";
import { Button } from "../ui/Button";
import { Menu } from "../ui/Menu";
import { pickedFiles } from "./dropped";

export function AddMenu({ words = "Add" }: { words?: string }) {
  const files = useRef<HTMLInputElement>(null);
  const folder = useRef<HTMLInputElement>(null);
  return (
    <>
      <Menu
        trigger={
          <Button look={words === "Add" ? "quiet" : "primary"} icon={Plus} aria-label="Add assets">
            {words}
          </Button>
        }
        lines={[
          { label: "A folder of assets…", onSelect: () => folder.current?.click() },
          { label: "Files…", onSelect: () => files.current?.click() },
        ]}
      />
      <Picker input={files} name="Files to add" />
      <Picker input={folder} name="Folder to add" folder />
    </>
  );
}

interface PickerProps {
  input: RefObject<HTMLInputElement | null>;
  name: string;
  folder?: boolean;
}

function Picker({ input, name, folder = false }: PickerProps) {
  return (
    <input
      ref={(element) => {
        input.current = element;
        if (element) element.webkitdirectory = folder;
      }}
      type="file"
      multiple
      hidden
      aria-label={name}
      onChange={(event) => {
        void addAssets(pickedFiles(event.target.files));
        event.target.value = "";
      }}
    />
  );
}
